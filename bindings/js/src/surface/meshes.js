// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells and triangles as vertices and triangles for a graphics card.

import { named, numbersFor } from "../arguments.js";
import { refineTriangles } from "./refine.js";

/** @typedef {import("../triangulation.js").VoronoiDiagram} VoronoiDiagram */

/**
 * A closed surface of triangles on the unit sphere, or as much of it as there are triangles.
 *
 * `positions` are x, y, z of unit vectors; `indices` three vertices for each triangle, counterclockwise seen from outside.
 * Vertices 0 ... numSites - 1 are the sites. The last `numCrossing` triangles cross the antimeridian, or have a pole in
 * them.
 *
 * Where cells are shown (`show` is "cells"), the last corner of each triangle says whose cell it is in: `sites` has the
 * site of each vertex that may be last, and noIndex for those on the border of cells. Where triangles are shown, vertices
 * behind the sites are middles: `parents` has two vertices for each.
 * @typedef {object} Mesh
 * @property {"cells" | "triangles"} show
 * @property {number} numSites
 * @property {Float32Array} positions
 * @property {Uint32Array} indices
 * @property {number} numCrossing
 * @property {Uint32Array} [sites]
 * @property {Uint32Array} [parents]
 */

const noIndex = 0xffffffff;

/**
 * Returns the numbers as a graphics card takes them. Zeros are positive, so that longitudes of the antimeridian are.
 * @param {Float64Array} values
 */
export function singles(values) {
  const result = new Float32Array(values.length);
  for (let i = 0; i < values.length; ++i) result[i] = Math.fround(values[i]) + 0;
  return result;
}

/**
 * Reorders triangles so that those that cross the antimeridian come last, and returns their number. A triangle does if
 * its corners are more than half a turn of longitude apart.
 * @param {Float32Array} positions
 * @param {Uint32Array} triangles
 */
export function putCrossingLast(positions, triangles) {
  const longitudes = new Float32Array(positions.length / 3);
  for (let v = 0; v < longitudes.length; ++v) longitudes[v] = Math.atan2(positions[3 * v + 1], positions[3 * v]);
  const indices = new Uint32Array(triangles.length);
  let [front, back] = [0, triangles.length];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [longitudes[triangles[t]], longitudes[triangles[t + 1]], longitudes[triangles[t + 2]]];
    const isCrossing = Math.max(a, b, c) - Math.min(a, b, c) > Math.PI;
    const place = isCrossing ? (back -= 3) : front;
    if (!isCrossing) front += 3;
    indices[place] = triangles[t];
    indices[place + 1] = triangles[t + 1];
    indices[place + 2] = triangles[t + 2];
  }
  return { indices, numCrossing: (triangles.length - back) / 3 };
}

/**
 * Returns the whole sphere as the cell of the only vertex of a diagram.
 * @param {number} numSites
 */
function wholeSphere(numSites) {
  const axes = [1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1];
  const triangles = [0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5];
  return { points: Float64Array.from(axes), triangles: Uint32Array.from(triangles, (corner) => corner + numSites) };
}

/**
 * Returns the cells as fans around their sites: a site is inside of its cell, which is convex.
 * @param {VoronoiDiagram} diagram
 */
function fans(diagram) {
  const n = diagram.numSites;
  if (diagram.numVertices === 1) return wholeSphere(n);
  const { offsets, rings, points } = diagram.cells;
  const triangles = new Uint32Array(3 * rings.length);
  let end = 0;
  for (let site = 0; site < n; ++site) {
    for (let k = offsets[site]; k < offsets[site + 1]; ++k) {
      const next = k + 1 < offsets[site + 1] ? k + 1 : offsets[site];
      triangles[end++] = n + rings[k];
      triangles[end++] = n + rings[next];
      triangles[end++] = site;
    }
  }
  return { points, triangles };
}

/**
 * Returns the site of each vertex that is inside of a cell, noIndex for those on borders. A middle is inside if one of
 * its parents is: two vertices on the border of a cell have a side in common only along it.
 * @param {number} numSites
 * @param {number} numOnBorders vertices that follow the sites
 * @param {Uint32Array} parents
 */
function sitesOfVertices(numSites, numOnBorders, parents) {
  const given = numSites + numOnBorders;
  const sites = new Uint32Array(given + parents.length / 2).fill(noIndex);
  for (let site = 0; site < numSites; ++site) sites[site] = site;
  for (let m = 0; m < parents.length / 2; ++m) {
    const [a, b] = [sites[parents[2 * m]], sites[parents[2 * m + 1]]];
    sites[given + m] = a !== noIndex ? a : b;
  }
  return sites;
}

/**
 * Turns the corners of triangles until the last one is inside of a cell.
 * @param {Uint32Array} triangles
 * @param {Uint32Array} sites of vertices
 */
function putInsideLast(triangles, sites) {
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]];
    if (sites[c] !== noIndex) continue;
    triangles.set(sites[b] !== noIndex ? [c, a, b] : [b, c, a], t);
  }
}

/** @param {Float64Array} first @param {Float64Array} second */
function joined(first, second) {
  const result = new Float64Array(first.length + second.length);
  result.set(first);
  result.set(second, first.length);
  return result;
}

/**
 * @param {VoronoiDiagram} diagram
 * @param {number} spacing degrees
 * @returns {Mesh}
 */
export function meshOfCells(diagram, spacing) {
  const numSites = diagram.numSites;
  const { points, triangles } = fans(diagram);
  const fine = refineTriangles(joined(diagram.points, points), triangles, spacing);
  // The octahedron of a single cell is inside of it; its corners belong to the only vertex, the first site.
  const isWhole = diagram.numVertices === 1;
  const sites = sitesOfVertices(numSites, points.length / 3, fine.parents);
  if (isWhole) sites.fill(0);
  else putInsideLast(fine.triangles, sites);
  const positions = singles(fine.points);
  const ordered = putCrossingLast(positions, fine.triangles);
  return { show: "cells", numSites, positions, ...ordered, sites };
}

/**
 * Returns the faces that the center of the sphere sees: all, if sites are not all on one side of it.
 * @param {import("../triangulation.js").Triangulation} triangulation
 */
export function solidFaces(triangulation) {
  const { triangles, ghostFaces } = triangulation;
  if (ghostFaces.length === 0) return triangles;
  const result = new Uint32Array(triangles.length - 3 * ghostFaces.length);
  let [ghost, end] = [0, 0];
  for (let face = 0; face < triangles.length / 3; ++face) {
    if (ghost < ghostFaces.length && ghostFaces[ghost] === face) {
      ++ghost;
      continue;
    }
    result.set(triangles.subarray(3 * face, 3 * face + 3), end);
    end += 3;
  }
  return result;
}

/**
 * @param {VoronoiDiagram} diagram
 * @param {number} spacing degrees
 * @returns {Mesh}
 */
export function meshOfTriangles(diagram, spacing) {
  const fine = refineTriangles(diagram.points, solidFaces(diagram), spacing);
  const positions = singles(fine.points);
  const ordered = putCrossingLast(positions, fine.triangles);
  return { show: "triangles", numSites: diagram.numSites, positions, ...ordered, parents: fine.parents };
}

/**
 * Returns a value for each vertex of a mesh: of cells that of the site whose cell it is in (NaN on borders, where no
 * triangle asks), of triangles the mean of two vertices at their middle.
 * @param {Mesh} mesh
 * @param {import("../arguments.js").Numbers} values one for each site; NaN: none
 * @returns {Float32Array}
 */
export function vertexValues(mesh, values) {
  const { numSites, sites, parents, positions } = named(mesh, undefined, "mesh");
  if (!ArrayBuffer.isView(positions) || !(sites ?? parents)) {
    throw new TypeError("mesh: cells or triangles that surface() made are wanted");
  }
  const known = numbersFor(values, numSites, "values", "sites");
  const result = new Float32Array(positions.length / 3);
  if (sites) {
    for (let v = 0; v < result.length; ++v) result[v] = sites[v] === noIndex ? NaN : known[sites[v]];
    return result;
  }
  for (let v = 0; v < numSites; ++v) result[v] = known[v];
  const pairs = parents ?? new Uint32Array(0);
  for (let m = 0; m < pairs.length / 2; ++m) {
    result[numSites + m] = (result[pairs[2 * m]] + result[pairs[2 * m + 1]]) / 2;
  }
  return result;
}
