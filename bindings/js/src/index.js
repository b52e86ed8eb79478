// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/**
 * Exact Delaunay triangulations, Voronoi, regular and power diagrams of points on a sphere.
 * Points are x, y, z one after the other in one array; the sphere is the unit sphere around the origin unless options
 * say otherwise; angles are radians unless they are longitudes and latitudes, which are degrees, longitude first.
 * Wrong values throw a RondelError, arguments of the wrong kind and options that do not exist a TypeError, by name, before
 * anything changes.
 * @module
 */

export { RondelError } from "./errors.js";
export { init } from "./engine.js";
export { noIndex } from "./located.js";
export { Triangulation, VoronoiDiagram } from "./triangulation.js";
export { delaunay, polarPoints, unitVectors, voronoi } from "./build.js";
export { DynamicTriangulation } from "./dynamic.js";
export { geoContour, geoDelaunay, geoVoronoi } from "./d3/index.js";
