// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The examples of the documents run, and print what the documents say they print.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

const block = /^```js\n([^]*?)^```\n(?:\n^```text\n([^]*?)^```)?/gm;

for (const document of ["docs/guide/javascript.md", "docs/guide/web-maps.md", "bindings/js/README.md", "README.md"]) {
  const text = readFileSync(join(process.env.RONDEL_SOURCE_DIR, document), "utf8");
  [...text.matchAll(block)].forEach(([, code, expected], i) => {
    test(`example ${i + 1} of ${document}`, () => {
      const file = new URL(`example_${document.replace(/\W/g, "_")}_${i}.mjs`, import.meta.url);
      writeFileSync(file, code);
      const printed = execFileSync(process.execPath, [file.pathname], { encoding: "utf8" });
      if (expected !== undefined) assert.equal(printed, expected);
    });
  });
}
