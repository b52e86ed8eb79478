// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The hashes of tests/same_bytes, of all kinds and both models, computed in WebAssembly.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { closeSync, mkdtempSync, openSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { WASI } from "node:wasi";

const { RONDEL_SOURCE_DIR: source, RONDEL_BIN_DIR: native } = process.env;

/** Runs a program of build/wasm on the files of two folders; returns its exit status and what it prints. */
async function runProgram(name, args, folders) {
  const output = join(folders["/work"], "output.txt");
  const stdout = openSync(output, "w");
  const wasi = new WASI({ version: "preview1", args: [name, ...args], preopens: folders, stdout, returnOnExit: true });
  const bytes = readFileSync(join(source, "build", "wasm", "bin", `${name}.wasm`));
  const { instance } = await WebAssembly.instantiate(bytes, { wasi_snapshot_preview1: wasi.wasiImport });
  const status = wasi.start(instance);
  closeSync(stdout);
  return { status, text: readFileSync(output, "utf8") };
}

test("results in WebAssembly have the bytes that are recorded", async (t) => {
  const work = mkdtempSync(join(tmpdir(), "rondel-same-bytes-"));
  t.after(() => rmSync(work, { recursive: true }));
  const recorded = join(source, "tests", "same_bytes");
  execFileSync(join(native, "same_bytes"), [join(recorded, "expected.txt"), "--write-sets", join(work, "sets.txt")]);

  const { status, text } = await runProgram("same_bytes_of", ["/recorded/expected.txt", "/work/sets.txt"], {
    "/recorded": recorded,
    "/work": work,
  });
  const lines = readFileSync(join(recorded, "expected.txt"), "utf8").trim().split("\n").length;
  assert.equal(text, `${lines} results, ${lines} recorded, 0 different\n`);
  assert.equal(status, 0);
});
