// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The hull of sites in a hemisphere: the faces that are no ghosts.

import { following } from "./planar.js";
import { cross, dot } from "./sphere.js";

/** @typedef {import("./sphere.js").Vector} Vector */
/** @typedef {import("../triangulation.js").VoronoiDiagram} VoronoiDiagram */

// Rounding moves sites on one side of a hull, such as sites on a meridian, inside by less than this, in radians.
const flat = 1e-14;

/** Returns the corner opposite to the longest edge of a face that is flat, or nothing if it is not flat.
 * @param {VoronoiDiagram} diagram
 * @param {number} face */
function flatCorner({ triangles, points }, face) {
  /** @type {Vector[]} */
  const p = [0, 1, 2].map((i) => {
    const at = 3 * triangles[3 * face + i];
    return [points[at], points[at + 1], points[at + 2]];
  });
  /** @param {Vector} a @param {Vector} b @returns {Vector} */
  const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const lengths = [0, 1, 2].map((i) => Math.hypot(...minus(p[(i + 1) % 3], p[(i + 2) % 3])));
  const longest = lengths.indexOf(Math.max(...lengths));
  const volume = dot(p[0], cross(minus(p[1], p[0]), minus(p[2], p[0])));
  return volume <= flat * lengths[longest] ? 3 * face + longest : -1;
}

/**
 * Returns the ghost faces, and the flat faces that are connected with them.
 * @param {VoronoiDiagram} diagram
 * @param {Uint8Array} isGhost
 */
function outsideOfHull(diagram, isGhost) {
  const { neighbors } = diagram;
  const isOutside = isGhost.slice();
  const waiting = Array.from(diagram.ghostFaces);
  for (let face = waiting.pop(); face !== undefined; face = waiting.pop()) {
    for (let h = 3 * face; h < 3 * face + 3; ++h) {
      const across = neighbors[h];
      if (isOutside[across]) continue;
      const corner = flatCorner(diagram, across);
      if (corner < 0 || neighbors[corner] !== face) continue;
      isOutside[across] = 1;
      waiting.push(across);
    }
  }
  return isOutside;
}

/**
 * Returns the sites of the hull, clockwise seen from outside, the lowest first; none if no face is a ghost.
 * @param {VoronoiDiagram} diagram
 * @param {Uint8Array} isGhost
 */
export function hullOf(diagram, isGhost) {
  const { neighbors, triangles } = diagram;
  const isOutside = outsideOfHull(diagram, isGhost);
  const next = new Map();
  for (let h = 0; h < triangles.length; ++h) {
    if (!isOutside[Math.floor(h / 3)] || isOutside[neighbors[h]]) continue;
    next.set(triangles[following(h)], triangles[following(following(h))]);
  }
  /** @type {number[]} */
  const result = [];
  if (next.size === 0) return result;
  const first = [...next.keys()].reduce((a, b) => Math.min(a, b));
  let corner = first;
  do {
    result.push(corner);
    corner = next.get(corner);
  } while (corner !== first && result.length < next.size);
  return result;
}
