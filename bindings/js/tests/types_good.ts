// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

import { delaunay, DynamicTriangulation, RondelError, voronoi, type VoronoiDiagram } from "rondel";
import { geoDelaunay, geoVoronoi } from "rondel/d3";
import { geoTriangulate, triangulate } from "rondel/polygons";
import { startWorker } from "rondel/worker";

const diagram: VoronoiDiagram = voronoi.lonLat(Int16Array.of(0, 0, 90, 0), { radii: [1, 2] });
const areas: Float64Array = diagram.areas;
const triangles: Uint32Array = delaunay(new Float64Array(9), { model: "weighted", center: [0, 0, 0] }).triangles;
const ids: Uint32Array = new DynamicTriangulation().insert([0, 0, 1]);
const polygons: (number[] | undefined)[] = geoDelaunay([[0, 0]]).polygons;
const index: number = new RondelError("no", 3).index;
const remote: Promise<Uint32Array> = startWorker().then((w) => w.delaunay([])).then((t) => t.nearest([0, 0, 1]));
const filled: Float64Array = triangulate({ type: "Polygon", coordinates: [] }, { edges: "geodesic", spacing: 2 }).points;
const corners: [number, number, number][] = geoTriangulate({ type: "Sphere" }, { spacing: 10 }).triangles;
{
  using freed = delaunay([0, 0, 1]);
  using sites = new DynamicTriangulation(freed.points);
  using snapshot: VoronoiDiagram = sites.snapshot();
}
export { areas, corners, filled, geoVoronoi, ids, index, polygons, remote, triangles };
