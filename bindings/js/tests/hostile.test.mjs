// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Wrong arguments of all that the package exports, found by reflection: what has no row in the table fails. Laws of each
// wrong call:
//
// 1. It throws, or rejects with, a RondelError with an index, or a TypeError.
// 2. Its message is one line that names the argument, and tells nothing of how the package works inside.
// 3. Where one of several elements is wrong, the index is that element.
// 4. What was called answers afterwards as before.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, test } from "node:test";
import { Worker } from "node:worker_threads";
import { Layer } from "@deck.gl/core";
import { delaunay, DynamicTriangulation, RondelError, voronoi } from "rondel";
import { SphereSites } from "rondel/maplibre";
import { DrawnSites, surface } from "rondel/surface";
import { startWorker } from "rondel/worker";
import { drawnOptions, folder, octahedron, places, placesKind, square } from "./hostile_kinds.mjs";
import { end, made, notPublic, reader, table } from "./hostile_table.mjs";
import { replaced } from "./hostile_values.mjs";

after(end);

const isClass = (value) => /^class\b/.test(Function.prototype.toString.call(value));

/** The names below a class: of its own, and those of its objects. */
function* namesOfClass(path, Type) {
  for (const name of Object.getOwnPropertyNames(Type)) {
    if (!["length", "name", "prototype"].includes(name)) yield `${path}.${name}`;
  }
  const isOurs = (prototype) => ![Object, Error, Layer].some((Outer) => Outer.prototype === prototype);
  for (let prototype = Type.prototype; isOurs(prototype); prototype = Object.getPrototypeOf(prototype)) {
    for (const name of Reflect.ownKeys(prototype)) if (name !== "constructor") yield `${path}#${String(name)}`;
  }
}

/** All that is public. Functions that several entries have are named by the first. */
async function* publicNames() {
  const { exports: entries } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const seen = new Set();
  for (const entry of Object.keys(entries).filter((name) => entries[name].types && name !== "./surface-worker")) {
    for (const [name, value] of Object.entries(await import(`rondel${entry.slice(1)}`))) {
      const path = `${entry === "." ? "rondel" : entry.slice(2)}.${name}`;
      if (typeof value !== "function") yield path;
      if (typeof value !== "function" || seen.has(value)) continue;
      seen.add(value);
      yield path;
      if (isClass(value)) yield* namesOfClass(path, value);
      else for (const inner of Object.keys(value)) yield `${path}.${inner}`;
    }
  }
  for (const [path, object] of Object.entries(made)) {
    if (typeof object === "function") yield path;
    for (const [name, value] of Object.entries(object)) {
      if (typeof value === "function" && !name.startsWith("_")) yield `${path}.${name}`;
    }
  }
}

test("all that is public has a row, and each row is of something public", async () => {
  const found = new Set();
  for await (const name of publicNames()) found.add(name);
  assert.deepEqual([...found].filter((path) => !(path in table)), []);
  assert.deepEqual(Object.keys(table).filter((path) => !found.has(path)), []);
  const types = ["triangulation", "located"].map((name) => readFileSync(join(folder, "types", `${name}.d.ts`), "utf8")).join();
  const hidden = Object.keys(table).filter((path) => table[path] === notPublic);
  for (const path of hidden) assert.match(types, new RegExp(`protected ${path.split("#")[1]}\\b`), path);
});

// Texts of engines, of WebAssembly and of C++.
const engines = /cannot |reading|iterable|destruct|convert|is not a (function|constructor)|private|proxy\b|symbol\(|\[object|stack/i;
const modules = /pointer|malloc|memory|embind|std::|rondel_|\bwasm\b|dataview|invalid (array|typed)|unreachable/i;
const sentence = /^[a-z"][^\n]{10,200}[^\s.,;:]$/i;
const noCopy = /^\S+: functions, symbols and proxies cannot be copied to a worker$/;

async function errorOf(call) {
  try {
    await call();
  } catch (error) {
    return error;
  }
  return undefined;
}

/**
 * Checks laws 1 to 3.
 * @param {any} error
 * @param {{index?: number, words: string[]}} wanted
 * @param {string} label
 */
function checkError(error, { index, words }, label) {
  assert.ok(error, `${label}: nothing was thrown`);
  const text = `${label}: ${error.stack}`;
  if (error instanceof RondelError) assert.ok(Number.isInteger(error.index) && error.index >= 0, text);
  else assert.equal(Object.getPrototypeOf(error), TypeError.prototype, text);
  assert.match(error.message, sentence, text);
  if (!noCopy.test(error.message)) assert.doesNotMatch(error.message, engines, text);
  assert.doesNotMatch(error.message, modules, text);
  const named = ` ${error.message.replace(/[^\w-]+/g, " ")} `;
  assert.ok(words.some((word) => named.includes(` ${word.replace(/[^\w-]+/g, " ").trim()} `)), `${text}: not one of ${words}`);
  if (index !== undefined) assert.equal(error.index, index, text);
}

/** A text of any value. */
function shown(value) {
  try {
    return JSON.stringify(value, (_, part) => (/bigint|symbol|function/.test(typeof part) ? String(part) : part)).slice(0, 200);
  } catch {
    return Object.prototype.toString.call(value);
  }
}

for (const [path, { call, kinds, isPure, state }] of Object.entries(table).filter(([, { call: given }]) => given)) {
  test(`${path} refuses what is wrong`, async () => {
    const before = await state();
    const good = kinds.map((kind) => kind.good);
    for (const [i, { bad, same, words: ofParameter }] of kinds.entries()) {
      assert.ok(bad.length >= 20, `argument ${i} has few wrong values`);
      for (const { value, index, words = ofParameter } of bad) {
        const label = `argument ${i} is ${shown(value)}`;
        const error = await errorOf(() => call(...replaced(good, i, value)));
        // What cannot be copied to a worker has no place there.
        const isSent = !noCopy.test(error?.message);
        checkError(error, isSent ? { index, words } : { words: ofParameter }, label);
        assert.deepEqual(await state(), before, `${label}: it is not as before`);
      }
      for (const value of isPure ? same : []) assert.deepEqual(await call(...replaced(good, i, value)), before);
    }
  });
}

const freed = {
  "rondel.Triangulation": delaunay(octahedron),
  "rondel.VoronoiDiagram": voronoi(octahedron),
  "rondel.DynamicTriangulation": new DynamicTriangulation(octahedron),
  "surface.DrawnSites": new DrawnSites(places),
};
for (const [path, object] of Object.entries(freed)) {
  test(`${path} says that it is used after free()`, async () => {
    object.free();
    object.free();
    const rows = Object.entries(table).filter(([name, row]) => name.startsWith(`${path}#`) && (row === reader || row.call));
    assert.ok(rows.length >= 3);
    for (const [name, row] of rows) {
      const member = name.slice(path.length + 1);
      const use = () => (row === reader ? object[member] : object[member](...row.kinds.map(({ good }) => good)));
      checkError(await errorOf(use), { index: 0, words: ["free"] }, name);
    }
  });
}

test("what a worker holds says that it is used after free(), or after stop()", async () => {
  const worker = await startWorker();
  const objects = [await worker.delaunay(octahedron), await worker.sites(places), await worker.voronoi(octahedron)];
  for (const object of [objects[0], objects[0], objects[1]]) await object.free();
  for (const call of [() => objects[0].nearest([0, 0, 1]), () => objects[1].drawn(), () => objects[1].nearest(0, 0)]) {
    checkError(await errorOf(call), { index: 0, words: ["free"] }, String(call));
  }
  await worker.stop();
  const closed = await SphereSites.open(places);
  await closed.close();
  const calls = [() => objects[2].nearest([0, 0, 1]), () => worker.delaunay(octahedron), () => worker.triangulate(square)];
  for (const call of [...calls, () => closed.at(0, 0), () => closed.drawn({ spacing: 33 })]) {
    checkError(await errorOf(call), { index: 0, words: ["stopped"] }, String(call));
  }
});

function canBeSent({ value }) {
  try {
    return structuredClone(value) !== null;
  } catch {
    return false;
  }
}

test("the worker for viewers answers wrong messages by errors, in their order", async (t) => {
  const viewer = new Worker(createRequire(import.meta.url).resolve("rondel/surface-worker"));
  t.after(() => viewer.terminate());
  const ofOptions = drawnOptions.bad.filter(({ words }) => words).map((bad) => ({ ...bad, value: { ...places, ...bad.value } }));
  const asked = [...placesKind.bad, ...ofOptions].filter(canBeSent);
  const answers = [];
  const all = new Promise((resolve) => viewer.on("message", (answer) => answers.push(answer) > asked.length && resolve()));
  const isObject = (value) => Object.prototype.toString.call(value) === "[object Object]";
  asked.forEach(({ value }, id) => viewer.postMessage(isObject(value) ? { ...value, id } : value));
  viewer.postMessage({ ...places, id: "last" });
  await all;
  assert.deepEqual(answers.pop(), { id: "last", ...surface(places) });
  answers.forEach(({ id, error }, i) => {
    const { value, index, words = placesKind.words } = asked[i];
    const Type = error?.name === "RondelError" ? RondelError : TypeError;
    checkError(error && Object.assign(new Type(error.message), { index: error.index }), { index, words }, shown(value));
    assert.equal(id, isObject(value) ? i : undefined);
  });
});
