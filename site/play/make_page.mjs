// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes the page to play, one file with all in it: make_page.mjs SOURCE PACKAGE PAGE
//
// PACKAGE is the folder of the npm package, which has the module. Browsers load no modules of JavaScript from file://, so
// that those of the page, and those of its worker, are one script each: one after the other, lower ones first, without
// their imports. A name at the top of one is thus in none of the others.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { deflateSync } from "node:zlib";

const [source, packageFolder, page] = process.argv.slice(2);
const read = (...path) => readFileSync(join(source, ...path), "utf8");

const namesIn = (list) => read("viewer", list).trim().split("\n");

const shared = namesIn("modules.txt");
const own = ["groups", "live", "presets", "table", "files", "history", "remote", "play", "start"];
const pageModules = [...shared.map((name) => ["viewer", "src", `${name}.js`]), ...own.map((name) => ["site", "play", "src", `${name}.js`])];
const library = ["errors", "arguments", "instance", "engine", "located", "triangulation", "build", "dynamic"];
const workerModules = [...library.map((name) => ["bindings", "js", "src", `${name}.js`]), ["site", "play", "src", "worker.js"]];

// Comments that begin a line go, as does the indentation. `given`: names that no module has.
function script(modules, given = []) {
  const names = new Set(given);
  const texts = modules.map((path) => {
    const whole = `\n${read(...path)}`;
    for (const [, list] of whole.matchAll(/\nimport {([^}]*)}/g)) {
      const missing = list.split(",").map((name) => name.trim()).find((name) => !names.has(name));
      if (missing) throw new Error(`${path.join("/")}: no module before it has the name ${missing}`);
    }
    const text = whole
      .replace(/\n *\/\*\*[\s\S]*?\*\/(?=\n)/g, "")
      .replace(/\n *\/\/[^\n]*/g, "")
      .replace(/\nimport [^;]*;/g, "")
      .replace(/\nexport (?=async|class|const|function)/g, "\n");
    if (/\n(import|export)\b/.test(text)) throw new Error(`${path.join("/")}: an import or export is not as expected`);
    for (const [, name] of text.matchAll(/\n(?:async )?(?:function|class|const|let) (\w+)/g)) {
      if (names.has(name)) throw new Error(`${path.join("/")}: another module has the name ${name}, too`);
      names.add(name);
    }
    return text.replace(/\n +/g, "\n").replace(/\n\n+/g, "\n");
  });
  const text = `(() => {\n"use strict";${texts.join("")}})();`;
  if (text.includes("</script") || text.includes("<!--")) throw new Error("a script would end the element that holds it");
  return text;
}

const arrays = [];
function data(name, bytes) {
  arrays.push({ name, kind: "u8", length: bytes.length });
  const text = deflateSync(bytes, { level: 9 }).toString("base64");
  return `<script type="application/octet-stream" id="data-${name}">${text}</script>\n`;
}

let frame = read("site", "play", "page.html");
for (const name of namesIn("parts.txt")) {
  const place = `\n@${name.toUpperCase()}@\n`;
  if (!frame.includes(place)) throw new Error(`page.html has no place for ${name}.html`);
  frame = frame.replace(place, () => `\n${read("viewer", "parts", `${name}.html`)}`);
}
const places = {
  "@STYLE@": read("viewer", "style.css") + read("site", "play", "style.css"),
  "@DATA@": data("module", readFileSync(join(packageFolder, "rondel.wasm"))) + data("coast", Buffer.from(read("data", "coast.txt"))),
  "@ABOUT@": JSON.stringify({ arrays }),
  "@WORKER@": script(workerModules, ["encodedModule"]).replace('"use strict";', '"use strict";\nconst encodedModule = "";'),
  "@SCRIPT@": script(pageModules),
  "@VERSION@": read("VERSION").trim(),
  "@LICENCES@": readFileSync(join(packageFolder, "THIRD_PARTY.md"), "utf8").replace(/&/g, "&amp;").replace(/</g, "&lt;"),
};
writeFileSync(page, frame.replace(/@[A-Z]+@/g, (place) => places[place]));
