// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/**
 * geoDelaunay, geoVoronoi and geoContour as d3-geo-voronoi 2.1 has them, exact for close, cocircular and equal points.
 * @module
 */

export { geoContour } from "./contour.js";
export { geoDelaunay } from "./delaunay.js";
export { geoVoronoi } from "./voronoi.js";
