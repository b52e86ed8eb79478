// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Isolines, and the borders of cells and triangles, as arcs.

import { refineSegments } from "./refine.js";
import { singles, solidFaces } from "./meshes.js";

/** @typedef {import("../triangulation.js").VoronoiDiagram} VoronoiDiagram */

/**
 * Arcs on the unit sphere: `segments` has six numbers for each, the unit vectors of its ends; `levels`, of isolines, the
 * level of each. The last `numCrossing` arcs cross the antimeridian.
 * @typedef {object} Lines
 * @property {"isolines" | "cell-borders" | "triangle-borders"} show
 * @property {Float32Array} segments
 * @property {number} numCrossing
 * @property {Float32Array} [levels]
 */

/**
 * Divides arcs that are longer than the spacing, and puts those last whose ends are more than half a turn of longitude
 * apart.
 * @param {Lines["show"]} show
 * @param {Float64Array} arcs
 * @param {number} spacing degrees
 * @param {number[]} [levels] one for each arc
 * @returns {Lines}
 */
function drawnLines(show, arcs, spacing, levels) {
  const fine = refineSegments(arcs, spacing);
  const given = singles(fine.segments);
  const n = given.length / 6;
  const segments = new Float32Array(given.length);
  const levelsInOrder = levels && new Float32Array(n);
  let [front, back] = [0, n];
  for (let s = 0; s < n; ++s) {
    const k = 6 * s;
    const turn = Math.abs(Math.atan2(given[k + 1], given[k]) - Math.atan2(given[k + 4], given[k + 3]));
    const place = turn > Math.PI ? --back : front++;
    segments.set(given.subarray(k, k + 6), 6 * place);
    if (levels && levelsInOrder) levelsInOrder[place] = levels[fine.origins ? fine.origins[s] : s];
  }
  return { show, segments, numCrossing: n - back, ...(levelsInOrder && { levels: levelsInOrder }) };
}

/**
 * Writes the point of a side at which the value is the level. Its ends are taken in the order of their numbers, so that
 * both triangles of the side find the same digits.
 * @param {Float64Array} points of sites
 * @param {ArrayLike<number>} values
 * @param {number} a
 * @param {number} b
 * @param {number} level
 * @param {number[]} segments
 */
function addCrossing(points, values, a, b, level, segments) {
  if (a > b) [a, b] = [b, a];
  const t = (level - values[a]) / (values[b] - values[a]);
  const x = points[3 * a] + t * (points[3 * b] - points[3 * a]);
  const y = points[3 * a + 1] + t * (points[3 * b + 1] - points[3 * a + 1]);
  const z = points[3 * a + 2] + t * (points[3 * b + 2] - points[3 * a + 2]);
  const length = Math.sqrt(x * x + y * y + z * z);
  segments.push(x / length, y / length, z / length);
}

/**
 * Finds the isolines of values that are linear in each triangle. A value that is the level counts as above it, so that
 * lines are closed, or end where triangles do: at sites without a value, and at the border of sites on one side of the
 * globe.
 * @param {VoronoiDiagram} diagram
 * @param {ArrayLike<number>} values one for each site; NaN: none
 * @param {ArrayLike<number>} levels
 * @param {number} spacing degrees: longer arcs are divided
 * @returns {Lines}
 */
export function isolines(diagram, values, levels, spacing) {
  const { points } = diagram;
  const triangles = solidFaces(diagram);
  /** @type {number[]} */
  const segments = [];
  /** @type {number[]} */
  const found = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [triangles[t], triangles[t + 1], triangles[t + 2]];
    const three = corners.map((site) => values[site]);
    const [least, most] = [Math.min(...three), Math.max(...three)];
    if (!Number.isFinite(least) || !Number.isFinite(most)) continue;
    for (let k = 0; k < levels.length; ++k) {
      const level = levels[k];
      if (!(least < level && level <= most)) continue;
      for (let i = 0; i < 3; ++i) {
        const j = (i + 1) % 3;
        if (three[i] >= level === three[j] >= level) continue;
        addCrossing(points, values, corners[i], corners[j], level, segments);
      }
      found.push(level);
    }
  }
  return drawnLines("isolines", Float64Array.from(segments), spacing, found);
}

/**
 * Returns the arcs between cells, each once.
 * @param {VoronoiDiagram} diagram
 * @param {number} spacing degrees
 * @returns {Lines}
 */
export function bordersOfCells(diagram, spacing) {
  const { offsets, rings, points } = diagram.cells;
  const segments = new Float64Array(3 * rings.length);
  let end = 0;
  for (let site = 0; site + 1 < offsets.length; ++site) {
    for (let k = offsets[site]; k < offsets[site + 1]; ++k) {
      const [a, b] = [rings[k], rings[k + 1 < offsets[site + 1] ? k + 1 : offsets[site]]];
      if (a > b) continue; // the neighbor goes along this arc the other way
      segments.set(points.subarray(3 * a, 3 * a + 3), end);
      segments.set(points.subarray(3 * b, 3 * b + 3), end + 3);
      end += 6;
    }
  }
  return drawnLines("cell-borders", segments.subarray(0, end), spacing);
}

/**
 * Returns the sides of triangles, each once.
 * @param {VoronoiDiagram} diagram
 * @param {number} spacing degrees
 * @returns {Lines}
 */
export function bordersOfTriangles(diagram, spacing) {
  const { points, edges } = diagram;
  const segments = new Float64Array(3 * edges.length);
  for (let e = 0; e < edges.length; ++e) segments.set(points.subarray(3 * edges[e], 3 * edges[e] + 3), 3 * e);
  return drawnLines("triangle-borders", segments, spacing);
}
