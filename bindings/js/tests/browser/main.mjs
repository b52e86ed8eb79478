// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the pages of the tests call, as a module of its own and as the entry of bundles.

import { delaunay, init, voronoi } from "rondel";
import { startWorker } from "rondel/worker";
import { geoJson, hashes, sites, typedArrays } from "./results.mjs";

/** The diagram of a worker, as text. */
async function fromWorker() {
  const worker = await startWorker();
  const { triangles, neighbors, cells, areas, nearest } = await worker.voronoi(sites.everywhere);
  const result = await hashes({ triangles, neighbors, cells, areas, nearest: await nearest(sites.close) });
  const error = await worker.delaunay([1, 0, 0, NaN, 0, 0]).catch(({ name, index }) => `${name} ${index}`);
  await worker.stop();
  return JSON.stringify({ ...result, error });
}

/** What fromWorker() must give, computed where this is called. */
async function withoutWorker() {
  const diagram = voronoi(sites.everywhere);
  const { triangles, neighbors, cells, areas } = diagram;
  const result = await hashes({ triangles, neighbors, cells, areas, nearest: diagram.nearest(sites.close) });
  return JSON.stringify({ ...result, error: "RondelError 1" });
}

/** Compiles, at once, a module that holds nothing but zeros to be so large. @param {number} size in bytes, more than 2^20 */
function compileAtOnce(size) {
  const bytes = new Uint8Array(size);
  bytes.set([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0, 0]); // magic number, version, a section that engines skip
  const length = size - 13; // in four digits of 7 bits; the section's name has no letters
  bytes.set([0, 7, 14, 21].map((shift) => ((length >> shift) & 127) | (shift < 21 ? 128 : 0)), 9);
  try {
    return new WebAssembly.Module(bytes) && "compiled";
  } catch (error) {
    return String(error);
  }
}

const octahedron = [1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1];

// At once, while the page is loading: no promise was awaited before.
const first = { numFaces: delaunay(octahedron).numFaces, state: globalThis.document?.readyState };

Object.assign(globalThis, { rondelTest: { compileAtOnce, first, init, fromWorker, geoJson, typedArrays, withoutWorker } });
