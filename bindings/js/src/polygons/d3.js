// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangles of polygons as d3-geo has them: sides are great circles, and what is inside is to the right of rings.

import { named } from "../arguments.js";
import { RondelError } from "../errors.js";
import { toLonLat } from "../d3/sphere.js";
import { unitVectorsBy } from "../instance.js";
import { engine } from "./engine.js";
import { flatPolygons } from "./geojson.js";
import { trianglesOf, wideOffsets, withMade } from "./triangulate.js";

/** @typedef {import("../d3/sphere.js").LonLat} LonLat */

/**
 * `triangles` are three positions in points each, counterclockwise seen from outside. `features` has those of each
 * feature.
 * @typedef {{points: LonLat[], triangles: [number, number, number][], features: [number, number, number][][]}} GeoTriangles
 */

/**
 * The rings of features with the interior to their left, each corner once: a polygon of arcs for each feature. A feature
 * that is the whole sphere has no rings, whatever polygons lie in its collection. Throws for a ring that is not closed, of
 * which d3-geo would take the last position for the first one.
 * @param {import("./geojson.js").FlatPolygons} flat
 */
function turnedRings({ features, polygons, rings, lonLat, isSphere }) {
  /** @type {{cells: number[], rings: number[], lonLat: number[]}} */
  const turned = { cells: [0], rings: [0], lonLat: [] };
  for (let f = 0; f < isSphere.length; ++f) {
    const end = isSphere[f] ? 0 : polygons[features[f + 1]];
    for (let r = polygons[features[f]]; r < end; ++r) {
      const positions = [];
      for (let k = rings[r]; k < rings[r + 1]; ++k) positions.push([lonLat[2 * k], lonLat[2 * k + 1]]);
      const [first, last] = [positions[0], positions[positions.length - 1]];
      if (first?.[0] !== last?.[0] || first?.[1] !== last?.[1]) throw new RondelError(`feature ${f}: a ring is not closed`, f);
      if (positions.length > 1) positions.pop();
      for (const [lon, lat] of positions.reverse()) turned.lonLat.push(lon, lat);
      turned.rings.push(turned.lonLat.length / 2);
    }
    turned.cells.push(turned.rings.length - 1);
  }
  return turned;
}

/**
 * Throws for rings that have no inside, and for sides that have no shortest way, since their ends are opposite.
 * @param {{cells: number[], rings: number[], lonLat: number[]}} turned
 * @param {Float64Array} corners their unit vectors
 */
function checkRings({ cells, rings, lonLat }, corners) {
  for (let f = 0; f + 1 < cells.length; ++f) {
    for (let r = cells[f]; r < cells[f + 1]; ++r) {
      const n = rings[r + 1] - rings[r];
      if (n < 3) throw new RondelError(`feature ${f}: a ring has ${n} corners, fewer than three`, f);
      for (let k = rings[r]; k < rings[r + 1]; ++k) {
        const next = k + 1 < rings[r + 1] ? k + 1 : rings[r];
        const isOpposite = [0, 1, 2].every((i) => corners[3 * k + i] === -corners[3 * next + i]);
        if (!isOpposite) continue;
        const ends = [k, next].map((p) => `[${lonLat[2 * p]}, ${lonLat[2 * p + 1]}]`).join(" and ");
        throw new RondelError(`feature ${f}: ${ends} are opposite to each other`, f);
      }
    }
  }
}

/**
 * Triangulates the inside of polygons as d3-geo reads them: great circles join positions, exterior rings are clockwise,
 * and a polygon may be larger than a hemisphere. Corners are the positions that were given.
 * @param {any} object GeoJSON, also {type: "Sphere"}
 * @param {{spacing?: number}} [options] `spacing` as for triangulate()
 * @returns {GeoTriangles}
 * @throws {RondelError} with the index of a feature whose rings are not closed, or do not divide in and out
 */
export function geoTriangulate(object, options = {}) {
  const { spacing = 0 } = named(options, ["spacing"]);
  const owner = engine();
  const flat = flatPolygons(object);
  const turned = turnedRings(flat);
  const { cells, rings, lonLat } = turned;
  const corners = unitVectorsBy(owner, Float64Array.from(lonLat));
  checkRings(turned, corners);
  const n = cells.length - 1;
  const whole = Uint32Array.from(flat.isSphere.flatMap((is, f) => (is ? [f] : [])));
  const made = withMade(
    owner,
    "rondel_polygons_free",
    (scope) =>
      scope.made(
        "rondel_polygons_create",
        scope.copy(wideOffsets(cells)),
        n,
        scope.copy(wideOffsets(rings)),
        scope.copy(corners),
        scope.copy(whole),
        whole.length,
      ),
    (polygons) => trianglesOf(owner, polygons, n, spacing),
  );
  /** @type {Map<string, LonLat>} */
  const given = new Map();
  for (let i = 0; i < lonLat.length / 2; ++i) {
    const key = corners.subarray(3 * i, 3 * i + 3).join();
    if (!given.has(key)) given.set(key, [lonLat[2 * i], lonLat[2 * i + 1]]);
  }
  const points = Array.from({ length: made.points.length / 3 }, (_, i) => {
    const [x, y, z] = made.points.subarray(3 * i, 3 * i + 3);
    return given.get(`${x},${y},${z}`) ?? toLonLat(x, y, z);
  });
  /** @type {[number, number, number][]} */
  const triangles = [];
  for (let t = 0; t < made.triangles.length; t += 3) {
    triangles.push([made.triangles[t], made.triangles[t + 1], made.triangles[t + 2]]);
  }
  const features = Array.from({ length: n }, (_, f) => triangles.slice(made.offsets[f], made.offsets[f + 1]));
  return { points, triangles, features };
}
