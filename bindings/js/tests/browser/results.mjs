// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the package computes, as text that tells every bit: for engines to be compared with each other. Sites are made
// by sums, products and quotients alone, which all engines round in the same way.

import { delaunay, DynamicTriangulation, geoContour, geoVoronoi, polarPoints, voronoi } from "rondel";
import { randomNumbers } from "../support.mjs";

/** n points of a cube around the center or about a place. @param {number} n @param {number[]} place @param {number} width */
function cloud(n, place, width) {
  const random = randomNumbers(n);
  return Float64Array.from({ length: 3 * n }, (_, i) => place[i % 3] + width * (2 * random() - 1));
}

/** The points of a grid of longitudes and latitudes, poles and date line among them. @param {number} step degrees */
function grid(step) {
  const result = [];
  for (let lat = -90; lat <= 90; lat += step) for (let lon = -180; lon <= 180; lon += step) result.push(lon, lat);
  return result;
}

const arrays = ["triangles", "neighbors", "ghostFaces", "ring", "duplicates", "hidden", "edges", "points", "centers", "centroids", "areas"];

/** @param {ArrayBufferView} array @returns {Promise<string>} its bytes' SHA-256, in hexadecimal digits */
async function hashOf(array) {
  const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  return Array.from(new Uint8Array(await crypto.subtle.digest("SHA-256", bytes)), (b) => b.toString(16).padStart(2, "0")).join("");
}

/** The hashes of all typed arrays in a value. @param {any} value @returns {Promise<any>} */
export async function hashes(value) {
  if (ArrayBuffer.isView(value)) return hashOf(value);
  if (value === null || typeof value !== "object") return value;
  const entries = Object.entries(value).filter(([, inner]) => typeof inner !== "function");
  return Object.fromEntries(await Promise.all(entries.map(async ([key, inner]) => [key, await hashes(inner)])));
}

export const sites = {
  everywhere: cloud(1000, [0, 0, 0], 1),
  close: cloud(500, [1, 2, 3], 1e-9),
  twice: Float64Array.from([...cloud(50, [0, 0, 0], 1), ...cloud(50, [0, 0, 0], 1)]),
  equator: Float64Array.from([1, 0, 0, 0, 1, 0, -1, 0, 0, 3, 4, 0]),
};

/** @param {Parameters<typeof voronoi>[0]} xyz @param {Parameters<typeof voronoi>[1]} [options] */
function everything(xyz, options) {
  const diagram = voronoi(xyz, options);
  const queries = cloud(100, [0, 0, 0], 1);
  const result = {
    ...Object.fromEntries(arrays.map((name) => [name, diagram[name]])),
    cells: diagram.cells,
    nearest: diagram.nearest(queries),
    kNearest: diagram.kNearest(queries, 5),
    within: diagram.within(queries, 0.2),
    located: diagram.locate(queries),
  };
  diagram.free();
  return result;
}

/** The text of all results of typed arrays. @returns {Promise<string>} */
export async function typedArrays() {
  const results = Object.entries(sites).map(([name, xyz]) => [name, everything(xyz)]);
  results.push(["weighted", everything(sites.everywhere, { model: "weighted" })]);
  const circles = polarPoints(grid(30), Array.from({ length: 13 * 7 }, (_, i) => i % 25));
  results.push(["circles", everything(circles, { model: "weighted" })]);
  results.push(["grid", delaunay.lonLat(grid(10)).triangles]);
  const dynamic = new DynamicTriangulation(sites.everywhere);
  dynamic.remove([3, 5]);
  dynamic.move(dynamic.insert(sites.equator), sites.close.subarray(0, 12));
  results.push(["dynamic", { ids: dynamic.ids, triangles: dynamic.snapshot().triangles }]);
  return JSON.stringify(await hashes(Object.fromEntries(results)), null, 1);
}

/** What the drop-in for d3 makes. */
export function geoJson() {
  const random = randomNumbers(7);
  const points = Array.from({ length: 200 }, () => [360 * random() - 180, 180 * random() - 90, random()]);
  const diagram = geoVoronoi(points);
  const names = ["polygons", "triangles", "links", "mesh", "cellMesh", "hull"];
  const results = names.map((name) => [name, diagram[name]()]);
  return [...results, geoContour()(points)];
}
