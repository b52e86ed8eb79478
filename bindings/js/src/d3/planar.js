// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The triangulation as d3-delaunay and d3-tricontour see one: flat arrays of a planar triangulation, here of all of
// the sphere, with a stereographic projection from the first site.

import { cross, dot, toLonLat, toVector } from "./sphere.js";

/** @typedef {import("./sphere.js").LonLat} LonLat */
/** @typedef {import("./sphere.js").Vector} Vector */

/** @param {number} h the halfedge, or corner, of the same face that follows */
export const following = (h) => (h % 3 === 2 ? h - 2 : h + 1);

/**
 * The stereographic projection that sends a place to infinity, with its invert().
 * @param {LonLat} pole
 */
export function stereographicFrom(pole) {
  const axis = toVector(pole);
  const lon = (pole[0] * Math.PI) / 180;
  /** @type {Vector} */
  const east = [-Math.sin(lon), Math.cos(lon), 0];
  const north = cross(axis, east);
  /** @param {LonLat} place @returns {[number, number]} */
  const project = (place) => {
    const v = toVector(place);
    const scale = 1 / (1 - dot(axis, v));
    return [scale * dot(east, v), scale * dot(north, v)];
  };
  /** @param {[number, number]} point @returns {LonLat} */
  const invert = ([x, y]) => {
    const square = x * x + y * y;
    if (!Number.isFinite(square)) return pole;
    const [a, b] = [2 / (square + 1), (square - 1) / (square + 1)];
    const v = [0, 1, 2].map((i) => a * (x * east[i] + y * north[i]) + b * axis[i]);
    return toLonLat(v[0], v[1], v[2]);
  };
  return Object.assign(project, { invert });
}

/**
 * The halfedge opposite to each, of faces and the faces across.
 * @param {Uint32Array} triangles
 * @param {Uint32Array} neighbors across the edges opposite to the corners
 */
function oppositeHalfedges(triangles, neighbors) {
  const halfedges = new Int32Array(triangles.length);
  for (let h = 0; h < triangles.length; ++h) {
    const face = h - (h % 3);
    const across = 3 * neighbors[face + ((h + 2) % 3)]; // halfedge h starts at corner h % 3
    const end = triangles[face + ((h + 1) % 3)];
    for (let i = 0; i < 3; ++i) if (triangles[across + i] === end) halfedges[h] = across + i;
  }
  return halfedges;
}

/**
 * @param {LonLat[]} places of all points; NaN for those that are not finite
 * @param {number} first the first that is finite
 * @param {Uint32Array} triangles positions in places
 * @param {Uint32Array} neighbors
 */
export function planarView(places, first, triangles, neighbors) {
  const projection = stereographicFrom(places[first]);
  const halfedges = oppositeHalfedges(triangles, neighbors);
  const inedges = new Int32Array(places.length).fill(-1);
  for (let h = 0; h < triangles.length; ++h) inedges[triangles[h - (h % 3) + ((h + 1) % 3)]] = h;
  return { points: Float64Array.from(places.flatMap(projection)), triangles, halfedges, inedges, projection };
}
