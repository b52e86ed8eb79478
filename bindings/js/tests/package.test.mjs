// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The files of the package, and the ways to load it.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, statSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { brotliCompressSync } from "node:zlib";

const folder = dirname(createRequire(import.meta.url).resolve("rondel/package.json"));
const description = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));

test("the package needs no other, and has a licence, types and a version", () => {
  assert.equal(description.dependencies, undefined);
  assert.equal(description.devDependencies, undefined);
  assert.ok(Object.keys(description.peerDependencies).every((name) => description.peerDependenciesMeta[name].optional));
  assert.equal(description.version, readFileSync(join(process.env.RONDEL_SOURCE_DIR, "VERSION"), "utf8").trim());
  for (const file of ["LICENSE", "THIRD_PARTY.md", "README.md", "rondel.wasm", "src/module.js", "polygons.wasm", "src/polygons/module.js"]) {
    assert.ok(statSync(join(folder, file)).size > 100, file);
  }
  for (const { types, default: code } of Object.values(description.exports).filter((e) => e.types)) {
    assert.ok(readFileSync(join(folder, types), "utf8").includes("export"));
    assert.ok(statSync(join(folder, code)).isFile());
  }
});

test("the guide says how much a page loads", () => {
  const guide = readFileSync(join(process.env.RONDEL_SOURCE_DIR, "docs", "guide", "javascript.md"), "utf8");
  const said = [...guide.split("\n## ")[0].matchAll(/(\d\.\d\d) MB/g)].map(([, size]) => Number(size));
  const sizes = ["src/module.js", "src/polygons/module.js"].map(
    (file) => brotliCompressSync(readFileSync(join(folder, file))).length / 1e6,
  );
  assert.equal(said.length, 2);
  said.forEach((size, i) => assert.ok(Math.abs(size - sizes[i]) < 0.01, `${size} ${sizes[i]}`));
});

test("the examples have the versions that are tested", () => {
  const read = (...path) => JSON.parse(readFileSync(join(process.env.RONDEL_SOURCE_DIR, ...path), "utf8"));
  const tested = read("bindings", "js", "package.json").devDependencies;
  const { rondel, ...others } = read("examples", "web", "package.json").dependencies;
  assert.equal(rondel, "file:../../build/js/package");
  for (const [name, version] of Object.entries(others)) assert.equal(version, tested[name], name);
});

test("the types say what the functions take", () => {
  const tsc = join(folder, "..", "typescript", "bin", "tsc");
  const check = (name, ...more) => {
    const flags = [...more, "--noEmit", "--strict", "--module", "nodenext", "--target", "es2022", "--lib", "es2022,dom", "--typeRoots", "/nonexistent"];
    execFileSync(process.execPath, [tsc, ...flags, new URL(name, import.meta.url).pathname]);
  };
  check("types_good.ts");
  check("types_layers.ts", "--skipLibCheck"); // with the types of MapLibre and deck.gl
  assert.throws(() => check("types_bad.ts"), (error) => [...String(error.stdout).matchAll(/error TS/g)].length === 5);
});

test("a page that cannot wait loads it without blocking", async () => {
  const { init, delaunay } = await import("rondel");
  await Promise.all([init(), init()]);
  assert.equal(delaunay([1, 0, 0]).numSites, 1);
});

test("the module may come from elsewhere", () => {
  const run = (source) => {
    const lines = [
      'import { readFileSync } from "node:fs";',
      'import { init, delaunay } from "rondel";',
      `await init(${source});`,
      "process.stdout.write(String(delaunay([1, 0, 0]).numSites));",
    ];
    const options = { cwd: new URL(".", import.meta.url), stdio: "pipe" };
    return String(execFileSync(process.execPath, ["--input-type=module", "--eval", lines.join("\n")], options));
  };
  const bytes = `readFileSync(${JSON.stringify(join(folder, "rondel.wasm"))})`;
  assert.equal(run(bytes), "1");
  assert.equal(run(`new WebAssembly.Module(${bytes})`), "1");
  assert.throws(() => run("new Uint8Array(8)"), /RondelError: source: this is not the package's module/);
});
