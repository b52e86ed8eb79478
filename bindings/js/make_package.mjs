// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Fills the folder of the npm package, except for its types: make_package.mjs SOURCE FOLDER

import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const [source, folder] = process.argv.slice(2);
const javascript = join(source, "bindings", "js");
const banner = "// SPDX-FileCopyrightText: The Rondel authors\n// SPDX-License-Identifier: Apache-2.0\n";

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
cpSync(join(javascript, "src"), join(folder, "src"), { recursive: true });
cpSync(join(javascript, "tsconfig.json"), join(folder, "tsconfig.json"));
cpSync(join(source, "LICENSE"), join(folder, "LICENSE"));
cpSync(join(javascript, "README.md"), join(folder, "README.md"));

// The version comes from VERSION; dependencies of development are left out.
const { devDependencies, ...description } = JSON.parse(readFileSync(join(javascript, "package.json"), "utf8"));
description.version = readFileSync(join(source, "VERSION"), "utf8").trim();
writeFileSync(join(folder, "package.json"), `${JSON.stringify(description, null, 2)}\n`);

// The package has each module twice: as a file, and as text that needs no request.
for (const [name, place] of [["rondel", "."], ["polygons", "polygons"]]) {
  const module = readFileSync(join(source, "build", "wasm", "bin", `${name}.wasm`));
  writeFileSync(join(folder, `${name}.wasm`), module);
  writeFileSync(
    join(folder, "src", place, "module.js"),
    `${banner}\n/** ${name}.wasm in base64. @type {string} */\nexport const encodedModule =\n  "${module.toString("base64")}";\n`,
  );
}

// Lists the libraries that the module contains besides Rondel.
const parts = execFileSync(join(source, "scripts", "tools", "third-party"), ["rondel.wasm holds", "llvm-wasm", "wasi-libc"]);
writeFileSync(join(folder, "THIRD_PARTY.md"), parts);
