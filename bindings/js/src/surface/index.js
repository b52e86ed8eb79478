// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/**
 * Surfaces of irregular points on the globe, as graphics cards take them: closed at the poles and across the
 * antimeridian, however far points are from each other. `rondel/surface-worker` does the same as a worker of its own.
 * @module
 */

import { DrawnSites } from "./sites.js";

export { RondelError } from "../errors.js";
export { vertexValues } from "./meshes.js";
export { DrawnSites } from "./sites.js";

/** @typedef {import("./lines.js").Lines} Lines */
/** @typedef {import("./meshes.js").Mesh} Mesh */
/** @typedef {import("./options.js").DrawnOptions} DrawnOptions */
/** @typedef {import("./sites.js").Places} Places */

/**
 * Returns the cells or triangles of sites as vertices and triangles, or lines as arcs.
 *
 *     const { positions, indices } = surface({ lon, lat }, { show: "triangles", spacing: 0 });
 *
 * With `spacing: 0` the vertices of triangles are the sites themselves.
 * @param {Places} places
 * @param {DrawnOptions} [options]
 * @returns {Mesh | Lines}
 * @throws {import("../errors.js").RondelError} with the index of the first site that is not a place
 */
export function surface(places, options = {}) {
  const sites = new DrawnSites(places);
  try {
    return sites.drawn(options);
  } finally {
    sites.free();
  }
}

/**
 * A request to `rondel/surface-worker`, and its answer, which has the request's `id`.
 * @typedef {Places & DrawnOptions & {id?: unknown}} SurfaceRequest
 * @typedef {{id?: unknown} & (Mesh | Lines | {error: {name: string, message: string, index?: number}})} SurfaceAnswer
 */
