// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Errors, and memory that is given back. RONDEL_LONG=1 makes all of the builds that a release is tested with.

import assert from "node:assert/strict";
import { test } from "node:test";
import { delaunay, DynamicTriangulation, RondelError, unitVectors, voronoi } from "rondel";
import { engine, separateEngine } from "../node_modules/rondel/src/engine.js";
import { build } from "../node_modules/rondel/src/build.js";
import { VoronoiDiagram } from "../node_modules/rondel/src/triangulation.js";
import { geoContour, geoDelaunay, geoVoronoi } from "rondel/d3";
import { randomLonLat, randomSites } from "./support.mjs";

const bytes = () => engine().memory.buffer.byteLength;
const numBuilds = process.env.RONDEL_LONG ? 10_000 : 200;

/** The error that a call throws. */
function errorOf(call) {
  try {
    call();
  } catch (error) {
    return error;
  }
  return assert.fail("nothing was thrown");
}

test("errors name the first bad element", () => {
  const tetrahedron = [1, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1];
  const bad = [
    [() => delaunay([1, 0, 0, 0, NaN, 0]), 1, /^site 1: \(0, nan, 0\) is not finite$/],
    [() => delaunay([1, 0, 0, 0, 0.1, 0, 0, 0, 0]), 2, /^site 2: \(0, 0, 0\) is the center of the sphere/],
    [() => delaunay([1, 0, 0, 1e-300, Infinity, -0.25]), 1, /^site 1: \(1e-300, inf, -0.25\) is not finite$/],
    [() => delaunay([1, 0, 0, 1]), 1, /^sites: the length 4 is no multiple of 3$/],
    [() => unitVectors([0, 0, 0, 0, 5, 91]), 2, /^site 2: latitude 91/],
    [() => delaunay(tetrahedron, { squaredRadius: -1 }), 0, /squared radius -1 of the sphere is not positive/],
    [() => delaunay(tetrahedron, { model: "flat" }), 0, /^model is "flat", not one of/],
    [() => delaunay(tetrahedron).nearest([1, 0, 0, 0, 0, 0]), 1, /./],
    [() => delaunay(tetrahedron).within([1, 0, 0], -1), 0, /^the angle -1 is negative/],
    [() => delaunay(tetrahedron).kNearest([1, 0, 0], -1), 0, /^k is -1, not a whole number/],
    [() => delaunay(tetrahedron).distance([1, 0, 0], 4), 4, /^there is no site 4$/],
    [() => new DynamicTriangulation(tetrahedron).remove([1, 7]), 1, /^site 7 does not exist$/],
    [() => new DynamicTriangulation(tetrahedron).remove([1, 2, 1]), 2, /appears twice/],
    [() => new DynamicTriangulation(tetrahedron).remove([0.5]), 0, /^ids: element 0 is 0.5, not an index$/],
    [() => new DynamicTriangulation(tetrahedron).moveAll([0, 0, 1]), 1, /^there are 1 points for 4 sites/],
    [() => new DynamicTriangulation(tetrahedron).move([0, 1], [0, 0, 1]), 0, /^there are 1 points for 2 sites/],
    [() => new DynamicTriangulation(tetrahedron).insert([0, 0, 1, 0, 0, 0]), 1, /^./],
  ];
  for (const [call, index, message] of bad) {
    const error = errorOf(call);
    assert.ok(error instanceof RondelError, String(error.stack));
    assert.equal(error.index, index, error.message);
    assert.match(error.message, message);
  }
  assert.throws(() => delaunay("1, 0, 0"), TypeError);
  const points = [[2, 48], [13, 52], [12, 41], [0, 0]];
  for (const call of [() => delaunay.lonLat(points), () => unitVectors(points), () => delaunay(points)]) {
    assert.throws(call, { name: "TypeError", message: /the array is flat, .* points.flat\(\) makes it/ });
  }
  assert.throws(() => delaunay(new DataView(new ArrayBuffer(24))), TypeError);
});

test("20,000 bad calls take no memory", () => {
  const xyz = randomSites(100, 1);
  xyz[150] = NaN;
  const call = () => assert.equal(errorOf(() => delaunay(xyz)).index, 50);
  for (let i = 0; i < 100; ++i) call();
  const before = bytes();
  for (let i = 0; i < 20_000; ++i) call();
  assert.equal(bytes(), before);
});

test(`${numBuilds} builds of 10,000 sites take the memory of one`, () => {
  const xyz = randomSites(10_000, 2);
  const round = () => {
    const diagram = voronoi(xyz);
    assert.equal(diagram.areas.length, 10_000);
    diagram.nearest([0, 0, 1]);
    diagram.free();
  };
  for (let i = 0; i < 3; ++i) round();
  const before = bytes();
  for (let i = 0; i < numBuilds; ++i) round();
  assert.equal(bytes(), before);
});

test("changes take no memory that they do not give back", () => {
  const dynamic = new DynamicTriangulation(randomSites(1000, 3));
  const xyz = randomSites(100, 4);
  const round = () => dynamic.remove(dynamic.insert(xyz));
  for (let i = 0; i < 20; ++i) round();
  const before = bytes();
  for (let i = 0; i < 200; ++i) round();
  assert.equal(bytes(), before);
  dynamic.free();
});

test("what is forgotten is freed by the garbage collector", { skip: globalThis.gc === undefined }, async () => {
  const xyz = randomSites(20_000, 5);
  for (let i = 0; i < 5; ++i) voronoi(xyz).free();
  for (let i = 0; i < 60; ++i) {
    voronoi(xyz);
    globalThis.gc();
    await new Promise((resolve) => setTimeout(resolve, 0));
  }
  assert.ok(bytes() < 200e6, `${bytes()} bytes`); // 60 triangulations that nobody freed take 110 MB more
});

test("diagrams in place of d3's take no more memory in a loop that never waits", () => {
  const points = randomLonLat(2000, 10);
  const first = geoVoronoi(points);
  const [cells, site] = [JSON.stringify(first.polygons()), first.find(10, 20)];
  const links = first.links().features.length;
  const before = bytes();
  const data = points.map(([lon, lat]) => [lon, lat, lat]);
  for (let i = 0; i < 300; ++i) {
    assert.equal(geoVoronoi(points).find(10, 20), site);
    assert.equal(geoDelaunay(points).polygons.length, 2000);
    assert.equal(geoContour().contour(data, 0).value, 0);
  }
  assert.ok(bytes() - before < 100e6, `${bytes() - before} bytes`); // 900 diagrams take 300 MB
  // What was freed meanwhile is made again.
  assert.equal(JSON.stringify(first.polygons()), cells);
  assert.equal(JSON.stringify(first(points).polygons()), cells);
  assert.equal(first.find(10, 20), site);
  assert.equal(first.links().features.length, links);
});

test("no more bytes are allocated than the module can count", () => {
  for (const n of [2 ** 32, 2 ** 32 + 8, 2 ** 33, 2 ** 53]) {
    assert.throws(() => engine().allocate(n), RangeError);
    assert.throws(() => engine().scoped((scope) => scope.room(n / 8 + 1, 8)), RangeError);
  }
});

test("a thing that was freed says so, and its arrays stay", () => {
  const diagram = voronoi(randomSites(10, 6));
  const { triangles } = diagram;
  diagram.free();
  diagram.free();
  assert.equal(diagram.triangles, triangles);
  assert.throws(() => diagram.neighbors, /used after free/);
  assert.throws(() => diagram.nearest([0, 0, 1]), /used after free/);
  const dynamic = new DynamicTriangulation(randomSites(10, 7));
  dynamic[Symbol.dispose ?? Symbol.for("Symbol.dispose")]();
  assert.throws(() => dynamic.ids, /used after free/);
});

test("memory that runs out is a RangeError, and the engine lives on", () => {
  const small = separateEngine({ maximumMemory: 32 << 20 });
  const reference = build(VoronoiDiagram, small, randomSites(5000, 8), {});
  const { triangles } = reference;
  reference.free();
  let numFailures = 0;
  for (let n = 50_000; n <= 1_500_000; n = Math.ceil(n * 1.4)) {
    const xyz = randomSites(n, 9);
    try {
      const diagram = build(VoronoiDiagram, small, xyz, {});
      try {
        assert.equal(diagram.areas.length, n);
      } finally {
        diagram.free();
      }
    } catch (error) {
      assert.ok(error instanceof RangeError, String(error.stack));
      assert.match(error.message, /out of memory/);
      ++numFailures;
    }
    const again = build(VoronoiDiagram, small, randomSites(5000, 8), {});
    assert.deepEqual(again.triangles, triangles);
    again.free();
  }
  assert.ok(numFailures >= 5);
});
