// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulations, diagrams and questions, against definitions and brute force.

import assert from "node:assert/strict";
import { test } from "node:test";
import { delaunay, DynamicTriangulation, noIndex, polarPoints, unitVectors, voronoi } from "rondel";
import { cross, difference, dot, point, randomSites, sum } from "./support.mjs";

const octahedron = [1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1];

test("no site lies above the plane of a face", () => {
  const xyz = randomSites(200, 1);
  const { triangles, numFaces } = delaunay(xyz);
  assert.equal(numFaces, 2 * 200 - 4);
  for (let f = 0; f < numFaces; ++f) {
    const [a, b, c] = [0, 1, 2].map((i) => point(xyz, triangles[3 * f + i]));
    const normal = cross(difference(b, a), difference(c, a));
    for (let s = 0; s < 200; ++s) assert.ok(dot(normal, difference(point(xyz, s), a)) < 1e-12, `${f} ${s}`);
  }
});

test("a neighbor has the edge the other way round", () => {
  const { triangles, neighbors } = delaunay(randomSites(100, 2));
  for (let h = 0; h < triangles.length; ++h) {
    const face = h - (h % 3);
    const [a, b] = [triangles[face + ((h + 1) % 3)], triangles[face + ((h + 2) % 3)]];
    const across = [0, 1, 2].map((i) => triangles[3 * neighbors[h] + i]);
    assert.equal(across[(across.indexOf(b) + 1) % 3], a);
  }
});

test("the cells of an octahedron are the faces of a cube", () => {
  const diagram = voronoi(octahedron);
  assert.equal(diagram.dimension, 2);
  assert.equal(diagram.model, "projected");
  assert.deepEqual([diagram.numSites, diagram.numVertices, diagram.numFaces], [6, 6, 8]);
  for (const area of diagram.areas) assert.ok(Math.abs(area - (4 * Math.PI) / 6) < 1e-14);
  for (const c of diagram.centers) assert.ok(Math.abs(Math.abs(c) - Math.sqrt(1 / 3)) < 1e-15);
  diagram.centroids.forEach((c, i) => assert.ok(Math.abs(c - octahedron[i]) < 1e-16));
  assert.deepEqual(diagram.points, Float64Array.from(octahedron));
  const { offsets, rings, points } = diagram.cells;
  assert.deepEqual([...offsets], [0, 4, 8, 12, 16, 20, 24]);
  assert.equal(points.length, 24);
  for (let site = 0; site < 6; ++site) {
    for (let i = offsets[site]; i < offsets[site + 1]; ++i) {
      assert.ok(dot(point(octahedron, site), point(points, rings[i])) > 0.5);
    }
  }
  assert.equal(diagram.edges.length, 2 * 12);
});

test("areas add up to the sphere", () => {
  assert.ok(Math.abs(sum(voronoi(randomSites(3000, 3)).areas) - 4 * Math.PI) < 1e-12);
});

test("degenerate sites have answers", () => {
  assert.equal(delaunay([]).dimension, -1);
  assert.equal(delaunay([0, 0, 2]).dimension, 0);
  const equator = delaunay.lonLat([0, 0, 90, 0, 200, 0, 90, 0]);
  assert.equal(equator.dimension, 1);
  assert.equal(equator.ring.length, 3);
  assert.deepEqual([...equator.duplicates], [3, 1]);
  assert.equal(equator.triangles.length, 0);
  assert.deepEqual([...delaunay([1, 0, 0]).nearest([0, 1, 0])], [0]);
  assert.deepEqual([...delaunay([]).nearest([0, 1, 0])], [noIndex]);
});

test("ghost faces are those that the center does not see", () => {
  const { ghostFaces } = delaunay.lonLat([0, 0, 10, 0, 0, 10]);
  assert.equal(ghostFaces.length, 1);
});

test("weighted sites may be hidden", () => {
  const power = voronoi.lonLat([0, 0, 0, 0.1, 90, 0, 180, 0, -90, 0, 0, 90, 0, -90], { radii: [40, 0, 1, 1, 1, 1, 1] });
  assert.equal(power.model, "weighted");
  assert.equal(power.hidden[0], 1);
  assert.equal(power.areas[1], 0);
  assert.ok(power.areas[0] > power.areas[3]);
  const sites = polarPoints([0, 0, 90, 0], [60, 0]);
  assert.ok(Math.abs(sites[0] - 2) < 1e-15);
  assert.deepEqual([...sites.subarray(3)], [0, 1, 0]);
});

test("the sphere may be elsewhere", () => {
  const moved = octahedron.map((x, i) => 5 * x + [1, 2, 3][i % 3]);
  const options = { center: [1, 2, 3], squaredRadius: 25 };
  assert.deepEqual(delaunay(moved, options).triangles, delaunay(octahedron).triangles);
});

test("float arrays and plain arrays are taken", () => {
  const expected = delaunay(Float64Array.from(octahedron)).triangles;
  assert.deepEqual(delaunay(octahedron).triangles, expected);
  assert.deepEqual(delaunay(Float32Array.from(octahedron)).triangles, expected);
});

test("arrays of derived classes are taken, whatever their constructors are", () => {
  class Vector extends Float64Array {
    constructor(x, y, z) {
      super(3);
      this.set([x, y, z]);
    }
  }
  class Numbers extends Float64Array {
    constructor(values) {
      super(values);
    }
  }
  class Ids extends Uint32Array {
    constructor(values) {
      super(values);
    }
  }
  assert.deepEqual(delaunay(new Numbers(octahedron)).triangles, delaunay(octahedron).triangles);
  const sites = new DynamicTriangulation(octahedron);
  const [id] = sites.insert(new Vector(0, 0.6, 0.8));
  assert.deepEqual([...sites.snapshot().points.slice(18)], [0, 0.6, 0.8]);
  sites.remove(new Ids([id]));
  assert.deepEqual(sites.snapshot().triangles, delaunay(octahedron).triangles);
});

test("nearest, k nearest and within agree with all distances", () => {
  const n = 300;
  const xyz = randomSites(n, 4);
  const queries = randomSites(50, 5);
  const t = delaunay(xyz);
  const [nearest, five, lists] = [t.nearest(queries), t.kNearest(queries, 5), t.within(queries, 0.3)];
  for (let q = 0; q < 50; ++q) {
    const cosines = Array.from({ length: n }, (_, s) => dot(point(xyz, s), point(queries, q)));
    const order = [...cosines.keys()].sort((a, b) => cosines[b] - cosines[a]);
    assert.equal(nearest[q], order[0]);
    assert.deepEqual([...five.subarray(5 * q, 5 * q + 5)], order.slice(0, 5));
    const close = [...cosines.keys()].filter((s) => cosines[s] >= Math.cos(0.3));
    assert.deepEqual([...lists.sites.subarray(lists.offsets[q], lists.offsets[q + 1])], close);
    assert.ok(Math.abs(t.distance(point(queries, q), order[0]) - Math.acos(cosines[order[0]])) < 1e-7);
  }
  assert.equal(t.kNearest([0, 0, 1], n + 1)[n], noIndex);
});

test("places are located on vertices, edges and faces", () => {
  const t = delaunay(octahedron);
  const { where, faces, sites } = t.locate([1, 0, 0, 1, 1, 0, 1, 2, 3]);
  assert.deepEqual([...where], [0, 1, 2]);
  assert.deepEqual([sites[0], sites[1], sites[2]], [0, noIndex, noIndex]);
  assert.deepEqual([...sites.subarray(3, 5)].sort(), [0, 1]);
  assert.deepEqual([...sites.subarray(6)].sort(), [0, 1, 4]);
  assert.deepEqual([...t.triangles.subarray(3 * faces[2], 3 * faces[2] + 3)].sort(), [0, 1, 4]);
  assert.deepEqual([...delaunay.lonLat([0, 0, 10, 0, 0, 10]).locate([-1, 0, 0]).where], [3]);
});

test("unit vectors of quadrants are exact", () => {
  assert.deepEqual([...unitVectors([0, 90, 90, 0, 180, 0])], [0, 0, 1, 0, 1, 0, -1, 0, 0]);
});

test("places in longitude and latitude have no other sphere", () => {
  for (const make of [delaunay, voronoi]) {
    for (const option of [{ center: [0, 0, 0.5] }, { squaredRadius: 2 }, { centre: 1 }]) {
      const [name] = Object.keys(option);
      assert.throws(() => make.lonLat([0, 0, 90, 0, 0, 90], option), {
        name: "TypeError",
        message: `options: there is no "${name}"; the names are model, radii`,
      });
      assert.throws(() => make.lonLat([0, 0, 90, 0, 0, 90], { radii: [1, 2, 3], ...option }), TypeError);
    }
  }
});
