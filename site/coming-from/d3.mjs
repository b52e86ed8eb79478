// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

import { geoArea } from "d3-geo";
import * as theirs from "d3-geo-voronoi";
import * as ours from "rondel/d3";

const names = (value) => Object.keys(value).filter((name) => !name.startsWith("_"));
const same = (what, a, b) => {
  const isSame = JSON.stringify(a) === JSON.stringify(b);
  console.log(`${what}:`, isSame ? "the same" : "different");
  if (!isSame) process.exitCode = 1;
};

// 500 places all around, by the golden angle.
const places = Array.from({ length: 500 }, (_, i) => [(i * 137.508) % 360 - 180, Math.asin((2 * i + 1) / 500 - 1) * 180 / Math.PI]);
const heights = places.map(([lon, lat], i) => [lon, lat, (i * 37) % 100]);

const missing = names(theirs).concat(names(theirs.geoVoronoi(places)), names(theirs.geoDelaunay(places)))
  .filter((name) => !(name in ours || name in ours.geoVoronoi(places) || name in ours.geoDelaunay(places)));
same("names", missing, []);

const a = theirs.geoVoronoi(places);
const b = ours.geoVoronoi(places);
const corners = ({ triangles }) => triangles.map((triangle) => [...triangle].sort((x, y) => x - y).join()).sort();
same("triangles", corners(a.delaunay), corners(b.delaunay));
same("ends of links", ...[a, b].map((one) => one.delaunay.edges.map((edge) => [...edge].sort((x, y) => x - y).join()).sort()));
same("neighbors", ...[a, b].map((one) => one.delaunay.neighbors.map((list) => [...list].sort((x, y) => x - y))));
same("find", ...[a, b].map((one) => places.map(([lon, lat]) => one.find(lon + 3, lat * 0.9))));
same("hull of all around", a.hull(), b.hull());

const areas = (one) => one.polygons().features.map((cell) => geoArea(cell));
const [theirAreas, ourAreas] = [areas(a), areas(b)];
same("areas to 1e-12", theirAreas.filter((area, i) => Math.abs(area - ourAreas[i]) > 1e-12), []);
const rings = ({ geoContour }) => geoContour().thresholds([20, 50, 80])(heights).map(({ value, coordinates }) => [value, coordinates.length]);
same("contours", rings(theirs), rings(ours));

// 300 sites within ten metres of each other
const close = Array.from({ length: 300 }, (_, i) => {
  const r = (5 / 111e3) * Math.sqrt((i + 0.5) / 300);
  return [10 + r * Math.cos(2.4 * i), 20 + r * Math.sin(2.4 * i)];
});
const covered = ({ geoVoronoi }) => geoVoronoi(close).polygons().features.reduce((sum, cell) => sum + geoArea(cell), 0).toFixed(6);
console.log("sum of all areas, d3-geo-voronoi:", covered(theirs));
console.log("sum of all areas, rondel/d3:     ", covered(ours));
