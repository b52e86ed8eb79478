// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the test suite of d3-geo-voronoi 2.1 expects, of the drop-in. Where that suite compares an order which follows
// from d3's planar triangulation, sets are compared, or rings wherever they begin: the tests whose name says so.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { geoArea } from "d3-geo";
import * as d3 from "d3-geo-voronoi";
import { geoContour, geoDelaunay, geoVoronoi } from "rondel/d3";

const three = [[0, 0], [10, 0], [0, 10]];
const five = [[10, 0], [10, 10], [3, 5], [-2, 5], [0, 0]];

const text = (p) => p.map((x) => (Math.abs(x) < 1e-9 ? 0 : +x.toFixed(9))).join(" ").replace(/^-180 /, "180 ");
const asSet = (list) => [...list].sort();

/** A closed ring as text, from its least point on. */
function turned(ring) {
  const points = ring.slice(0, -1).map(text);
  assert.equal(text(ring[0]), text(ring.at(-1)));
  const first = points.indexOf(asSet(points)[0]);
  return [...points.slice(first), ...points.slice(0, first)];
}

test("geoVoronoi() is a diagram", () => {
  for (const name of ["links", "polygons", "triangles"]) {
    assert.equal(typeof geoVoronoi()[name], "function");
    assert.equal(typeof geoVoronoi()[name]([]), "object");
    assert.equal(geoVoronoi()[name](), false);
  }
  assert.equal(typeof geoVoronoi([]), "function");
});

test("two sites have two hemispheres, rings wherever they begin", () => {
  const { features } = geoVoronoi([[-20, -20], [20, 20]]).polygons();
  const a = [[0, 0], [90, -43.21917889371418], [180, 0], [-90, 43.21917889371418], [0, 0]];
  assert.deepEqual(turned(features[0].geometry.coordinates[0]), turned(a));
  assert.deepEqual(turned(features[1].geometry.coordinates[0]), turned(a.reverse()));
});

test("polygons have the centers of the triangles, rings wherever they begin", () => {
  const [ring] = geoVoronoi(three).polygons().features[0].geometry.coordinates;
  assert.ok(ring.some((u) => Math.abs(u[0] + 175) < 1e-6 && Math.abs(u[1] + 4.981069) < 1e-6));
});

test("sites that are not finite are left out", () => {
  assert.equal(geoVoronoi([[0, 0], [2, 1], [NaN, -1], [4, NaN], [5, 10]]).polygons().features.length, 3);
  assert.deepEqual(geoVoronoi([[NaN, -1], [4, NaN], [Infinity, 10]]).polygons().features, []);
  const { features } = geoVoronoi([[NaN, -1], [4, NaN], [5, 10]]).polygons();
  assert.equal(features[0].type, "Feature");
  assert.equal(features[0].geometry.type, "Sphere");
  const { triangles, neighbors } = geoDelaunay([[0, 0], [NaN, 0], [10, 0], [0, 10]]);
  assert.deepEqual(asSet(triangles[0]), [0, 2, 3]);
  assert.deepEqual(neighbors[1], []);
});

test("links have sources and the Urquhart graph, links as sets", () => {
  const { features } = geoVoronoi().links(three);
  const found = features.map(({ properties: { source, urquhart } }) => `${source[0]} ${urquhart}`);
  assert.deepEqual(asSet(features.map((f) => f.properties.source[0])), asSet([10, 0, 0]));
  assert.deepEqual(asSet(features.map((f) => f.properties.urquhart)), [false, true, true]);
  assert.ok(found.includes("10 false"));
  assert.ok(Math.abs(features[0].properties.length) > 0.1);
});

test("x() and y() read data", () => {
  const data = [{ lon: 10, lat: 0 }, { lon: 3, lat: 5 }, { lon: -2, lat: 5 }];
  const v = geoVoronoi().x((d) => +d.lon).y((d) => +d.lat)(data);
  assert.deepEqual(v.points, [[10, 0], [3, 5], [-2, 5]]);
  assert.equal(v.x()(data[0]), 10);
});

test("the hull of five sites, ring wherever it begins", () => {
  const hull = geoVoronoi().hull(five);
  assert.equal(hull.type, "Polygon");
  assert.deepEqual(turned(hull.coordinates[0]), turned([[10, 0], [0, 0], [-2, 5], [10, 10], [10, 0]]));
});

test("the mesh of five sites, edges as sets", () => {
  const { type, coordinates } = geoVoronoi().mesh(five);
  assert.equal(type, "MultiLineString");
  const edges = ["3 5/-2 5", "3 5/0 0", "-2 5/0 0", "10 10/-2 5", "10 10/3 5", "10 0/3 5", "10 0/0 0", "10 0/10 10"];
  assert.deepEqual(asSet(coordinates.map((e) => asSet(e.map(text)).join("/"))), asSet(edges.map((e) => asSet(e.split("/")).join("/"))));
});

// Two of the centers lie at longitude 0.5 to the last bit, and d3's suite rounds that to 0 and to 1: whole tenths are compared.
test("the mesh of the polygons of five sites", () => {
  const rounded = (edge) => asSet(edge.map((p) => p.map((x) => (Math.round(10 * x) + 0) / 10).join(" "))).join("/");
  const edges = geoVoronoi(five).cellMesh().coordinates;
  assert.deepEqual(asSet(edges.map(rounded)), asSet(d3.geoVoronoi(five).cellMesh().coordinates.map(rounded)));
  const asInSuite = ["-175 -5/-175 -5", "-175 -5/.5 3", "-175 -5/.5 15", "-175 -5/5 0", "-175 -5/8 5"];
  asInSuite.push(".5 3/.5 15", ".5 3/5 0", ".5 15/8 5", "5 0/8 5");
  const coarse = (edge) => asSet(edge.map((p) => p.map((x, i) => (i === 0 && Math.abs(x - 0.5) < 1e-9 ? ".5" : `${Math.round(x) + 0}`)).join(" ")));
  assert.deepEqual(asSet(edges.map((e) => coarse(e).join("/"))), asSet(asInSuite.map((e) => asSet(e.split("/")).join("/"))));
});

test("find() finds", () => {
  const v = geoVoronoi(five);
  assert.equal(v.find(1, 1), 4);
  assert.equal(v.find(1, 1, 4), 4);
  assert.equal(v.find(100, 1, 0.1), undefined);
});

test("triangles are those that face away from the center, with circumcenters", () => {
  const triangles = geoVoronoi().triangles(three);
  assert.equal(triangles.type, "FeatureCollection");
  assert.equal(triangles.features.length, 1);
  const u = triangles.features[0].properties.circumcenter;
  assert.ok(Math.abs(u[0] - 5) < 1e-6 && Math.abs(u[1] - 4.981069) < 1e-6);
  assert.equal(Math.max(...geoVoronoi()(three).delaunay.delaunay.triangles), 2);
});

test("hulls of difficult polygons, rings wherever they begin", () => {
  const { hulls } = JSON.parse(readFileSync(new URL("d3_hulls.json", import.meta.url), "utf8"));
  for (const { points, hull } of hulls) {
    const found = geoVoronoi(points).hull();
    if (hull === null) assert.equal(found, null);
    else assert.deepEqual(turned(found.coordinates[0]), turned(hull));
  }
});

test("contours have the areas that d3 finds", () => {
  assert.ok(geoContour()([[0, 0, 0], [10, 0, 1], [0, 10, 2], [30, 90, 3]]));
  const sites = Array.from({ length: 500 }, (_, i) => [180 * Math.sin(i), 90 * Math.cos((i * 7) / 11), i]);
  const areas = geoContour()(sites).map((d) => Math.round(100 * geoArea(d)) / 100);
  assert.deepEqual(areas, [0, 12.36, 11.41, 9.58, 7.57, 5.78, 4.18, 2.93, 1.8, 0.39, 0]);
});
