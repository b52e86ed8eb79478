// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/**
 * Triangles of polygons on a sphere: as RFC 7946 has them, triangulate(), and as d3-geo has them, geoTriangulate(). What
 * computes with polygons is a module of its own, polygons.wasm, so that other pages do not load it.
 * @module
 */

export { RondelError } from "../errors.js";
export { init } from "./engine.js";
export { geoTriangulate } from "./d3.js";
export { triangulate } from "./triangulate.js";
