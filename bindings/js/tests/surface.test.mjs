// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Surfaces of cells and triangles: closed, of the area of the sphere, and the right color everywhere, by brute force.

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { test } from "node:test";
import { Worker } from "node:worker_threads";
import { delaunay, unitVectors } from "rondel";
import { DrawnSites, surface, vertexValues } from "rondel/surface";
import { startWorker } from "rondel/worker";
import { cross, difference, dot, point, randomLonLat, randomNumbers } from "./support.mjs";

const radians = Math.PI / 180;

/** Arrays of longitudes and latitudes. @param {number[][]} pairs */
const places = (pairs) => ({ lon: pairs.map(([lon]) => lon), lat: pairs.map(([, lat]) => lat) });

/** Longitudes and latitudes in a cap about a place. */
function cluster(n, lon, lat, width, seed) {
  const random = randomNumbers(seed);
  return Array.from({ length: n }, () => [lon + width * (random() - 0.5), lat + width * (random() - 0.5)]);
}

/** A curvilinear grid of an ocean model: rows in the south, and in the north ovals around two poles on land. */
function tripolar(rows, columns) {
  const pairs = [];
  for (let j = 0; j < rows; ++j) {
    for (let i = 0; i < columns; ++i) {
      const [lon, lat] = [(360 * i) / columns, -78 + (168 * (j + 0.5)) / rows];
      const pull = Math.max(0, (lat - 40) / 50) ** 2;
      pairs.push([lon + 25 * pull * Math.sin(2 * lon * radians), lat - 25 * pull * Math.cos(lon * radians) ** 2]);
    }
  }
  return pairs;
}

const inputs = {
  one: [[10, 20]],
  two: [[0, 0], [90, 10]],
  circle: Array.from({ length: 8 }, (_, i) => [45 * i, 0]),
  octahedron: [[0, 0], [90, 0], [180, 0], [-90, 0], [0, 90], [0, -90]],
  few: randomLonLat(12, 1),
  many: randomLonLat(3000, 2),
  duplicates: [...randomLonLat(40, 3), ...randomLonLat(40, 3)],
  clusters: [...cluster(200, 179.9, 10, 1, 4), ...cluster(200, 0, 89.9, 0.1, 5), [0, -90]],
  hemisphere: cluster(60, 30, 40, 50, 6),
  tripolar: tripolar(40, 90),
};

/** The corners of triangle t as vectors. */
const corners = ({ positions, indices }, t) => [0, 1, 2].map((k) => point(positions, indices[3 * t + k]));

/** The area of a triangle on the sphere (van Oosterom and Strackee); negative if it is clockwise. */
function area([a, b, c]) {
  const below = 1 + dot(a, b) + dot(b, c) + dot(c, a);
  return 2 * Math.atan2(dot(a, cross(b, c)), below);
}

function totalArea(mesh) {
  let total = 0;
  for (let t = 0; t < mesh.indices.length / 3; ++t) total += area(corners(mesh, t));
  return total;
}

/** The number of sides that no triangle has the other way round; fails if two triangles have one the same way. */
function openSides({ indices }) {
  const sides = new Set();
  for (let t = 0; t < indices.length; t += 3) {
    for (let k = 0; k < 3; ++k) {
      const side = `${indices[t + k]} ${indices[t + ((k + 1) % 3)]}`;
      assert.ok(!sides.has(side), `the side ${side} is there twice`);
      sides.add(side);
    }
  }
  return [...sides].filter((side) => !sides.has(side.split(" ").reverse().join(" "))).length;
}

function longestSide(mesh) {
  let longest = 0;
  for (let t = 0; t < mesh.indices.length / 3; ++t) {
    const [a, b, c] = corners(mesh, t);
    for (const [p, q] of [[a, b], [b, c], [c, a]]) {
      const d = difference(p, q);
      longest = Math.max(longest, 2 * Math.asin(Math.sqrt(dot(d, d)) / 2));
    }
  }
  return longest / radians;
}

for (const [name, pairs] of Object.entries(inputs)) {
  test(`cells of ${name} are closed, cover the sphere once, and have the color of the nearest site`, () => {
    const xyz = unitVectors(pairs.flat());
    for (const spacing of [2, 20]) {
      const mesh = surface(places(pairs), { spacing });
      assert.equal(openSides(mesh), 0);
      assert.ok(Math.abs(totalArea(mesh) / (4 * Math.PI) - 1) < 1e-6);
      assert.ok(longestSide(mesh) < spacing + 1e-4);
      const step = Math.max(1, Math.floor(mesh.indices.length / 3 / 300));
      for (let t = 0; t < mesh.indices.length / 3; t += step) {
        const [a, b, c] = corners(mesh, t);
        const middle = a.map((x, k) => x + b[k] + c[k]);
        if (area([a, b, c]) < 1e-9) continue; // single precision does not tell where it is
        const site = mesh.sites[mesh.indices[3 * t + 2]];
        const best = Math.max(...pairs.map((_, i) => dot(middle, point(xyz, i))));
        assert.ok(best - dot(middle, point(xyz, site)) < 1e-6, `triangle ${t} has the color of ${site}`);
      }
    }
  });

  test(`triangles of ${name} are those of the triangulation, and closed if it is`, () => {
    const { triangles, ghostFaces, dimension } = delaunay.lonLat(pairs.flat());
    const plain = surface(places(pairs), { show: "triangles", spacing: 0 });
    assert.equal(plain.positions.length, 3 * pairs.length);
    const faces = (list) => {
      const rows = Array.from({ length: list.length / 3 }, (_, t) => [...list.slice(3 * t, 3 * t + 3)]);
      return rows.map(([a, b, c]) => (a < b && a < c ? [a, b, c] : b < c ? [b, c, a] : [c, a, b]).join()).sort();
    };
    const ghosts = new Set(ghostFaces);
    const solid = triangles.filter((_, k) => !ghosts.has(Math.floor(k / 3)));
    assert.deepEqual(faces(plain.indices), faces(solid));
    const mesh = surface(places(pairs), { show: "triangles" });
    assert.ok(longestSide(mesh) < 2 + 1e-4);
    if (dimension === 2 && ghostFaces.length === 0) {
      assert.equal(openSides(mesh), 0);
      assert.ok(Math.abs(totalArea(mesh) / (4 * Math.PI) - 1) < 1e-6);
    }
  });
}

test("triangles over the antimeridian and the poles come last", () => {
  for (const show of ["cells", "triangles"]) {
    const mesh = surface(places(inputs.clusters), { show });
    const n = mesh.indices.length / 3;
    assert.ok(mesh.numCrossing > 0);
    for (let t = 0; t < n; ++t) {
      const longitudes = corners(mesh, t).map(([x, y]) => Math.atan2(y, x));
      const isCrossing = Math.max(...longitudes) - Math.min(...longitudes) > Math.PI;
      assert.equal(isCrossing, t >= n - mesh.numCrossing, `${show} ${t}`);
    }
  }
});

test("values of vertices are those of sites, and linear at middles", () => {
  const pairs = inputs.few;
  const values = pairs.map(([lon]) => lon);
  values[3] = NaN;
  const cells = surface(places(pairs));
  const ofCells = vertexValues(cells, values);
  for (let t = 0; t < cells.indices.length; t += 3) {
    assert.ok(Object.is(ofCells[cells.indices[t + 2]], Math.fround(values[cells.sites[cells.indices[t + 2]]])));
  }
  const triangles = surface(places(pairs), { show: "triangles" });
  const ofTriangles = vertexValues(triangles, values);
  const { parents, numSites } = triangles;
  assert.ok(parents.length > 1000);
  for (let m = 0; m < parents.length / 2; ++m) {
    const expected = (ofTriangles[parents[2 * m]] + ofTriangles[parents[2 * m + 1]]) / 2;
    assert.ok(Object.is(ofTriangles[numSites + m], Math.fround(expected)));
  }
  assert.throws(() => vertexValues(cells, [1, 2]), { name: "RondelError", index: 2 });
});

test("isolines are closed, lie where the field has the level, and end where values are missing", () => {
  const pairs = inputs.many;
  const values = pairs.map(([lon, lat]) => Math.sin(2 * lon * radians) * Math.cos(lat * radians));
  const drawn = { show: "isolines", levels: [-0.3, 0, 0.3], spacing: 0 };
  const ends = ({ segments }) => {
    const counts = new Map();
    for (let k = 0; k < segments.length; k += 3) {
      const key = segments.slice(k, k + 3).join();
      counts.set(key, (counts.get(key) ?? 0) + 1);
    }
    return [...counts.values()].filter((count) => count % 2 === 1).length;
  };
  const lines = surface(places(pairs), { ...drawn, values });
  assert.ok(lines.segments.length / 6 > 500);
  assert.equal(ends(lines), 0);
  for (let s = 0; s < lines.levels.length; ++s) {
    const [x, y, z] = point(lines.segments, 2 * s);
    const there = Math.sin(2 * Math.atan2(y, x)) * Math.sqrt(1 - z * z);
    assert.ok(Math.abs(there - lines.levels[s]) < 0.1); // sites are some 4 degrees apart
  }
  const some = values.map((value, i) => (i % 50 === 0 ? NaN : value));
  const cut = surface(places(pairs), { ...drawn, values: some });
  assert.ok(ends(cut) > 0);
  assert.ok(cut.segments.length < lines.segments.length);
  const fine = surface(places(inputs.few), { show: "isolines", levels: [0], values: inputs.few.map(([lon]) => lon) });
  assert.equal(ends(fine), 0);
  for (let s = 0; s < fine.segments.length / 6; ++s) {
    const d = difference(point(fine.segments, 2 * s), point(fine.segments, 2 * s + 1));
    assert.ok(Math.sqrt(dot(d, d)) < 2.001 * radians);
  }
});

test("a level that a site has is above it", () => {
  const octahedron = places(inputs.octahedron);
  const lines = surface(octahedron, { show: "isolines", values: [1, 1, 1, 1, 2, 0], levels: [1], spacing: 0 });
  assert.equal(lines.segments.length / 6, 4); // around the equator, as seen from the south
  for (let k = 2; k < lines.segments.length; k += 3) assert.equal(lines.segments[k], 0);
  const none = surface(octahedron, { show: "isolines", values: [1, 1, 1, 1, 1, 1], levels: [1] });
  assert.equal(none.segments.length, 0);
});

test("borders are each there once", () => {
  for (const pairs of [inputs.many, inputs.clusters, inputs.octahedron]) {
    const triangulation = delaunay.lonLat(pairs.flat());
    const cells = surface(places(pairs), { show: "cell-borders", spacing: 0 });
    assert.ok(cells.segments.length / 6 >= triangulation.edges.length / 2);
    const triangles = surface(places(pairs), { show: "triangle-borders", spacing: 0 });
    assert.equal(triangles.segments.length / 6, triangulation.edges.length / 2);
    for (const { segments } of [cells, triangles]) {
      const seen = new Set(Array.from({ length: segments.length / 6 }, (_, s) => segments.slice(6 * s, 6 * s + 6).join()));
      assert.equal(seen.size, segments.length / 6);
    }
  }
});

test("what is wrong is told with its place", () => {
  assert.throws(() => surface({ lon: [0, 1], lat: [0, 91] }), { name: "RondelError", index: 1 });
  assert.throws(() => surface({ lon: [0, NaN], lat: [0, 1] }), { name: "RondelError", index: 1 });
  assert.throws(() => surface({ lon: [0, 1, 2], lat: [0, 1] }), { name: "RondelError", index: 2 });
  assert.throws(() => surface({ lon: [0] }), TypeError);
  const sites = new DrawnSites(places(inputs.few));
  assert.throws(() => sites.drawn({ show: "hexagons" }), { name: "RondelError" });
  assert.throws(() => sites.drawn({ spacing: -1 }), { name: "RondelError" });
  assert.throws(() => sites.drawn({ show: "isolines", levels: [1] }), TypeError);
  assert.throws(() => sites.drawn({ show: "isolines", levels: [1], values: [1] }), { name: "RondelError", index: 1 });
  assert.equal(surface({ lon: [], lat: [] }).indices.length, 0);
});

test("the worker of viewers answers plain messages", async (t) => {
  const worker = new Worker(createRequire(import.meta.url).resolve("rondel/surface-worker"));
  t.after(() => worker.terminate());
  const answers = [];
  const asked = 4;
  const all = new Promise((resolve) => worker.on("message", (answer) => answers.push(answer) === asked && resolve()));
  const { lon, lat } = places(inputs.tripolar);
  worker.postMessage({ id: "a", lon: Float32Array.from(lon), lat: Float32Array.from(lat), show: "triangles", spacing: 0 });
  worker.postMessage({ id: 7, lon, lat });
  worker.postMessage({ id: 8, lon, lat: [0] });
  worker.postMessage(null);
  await all;
  const [triangles, cells, error, nothing] = answers;
  const rounded = { lon: lon.map(Math.fround), lat: lat.map(Math.fround) };
  assert.deepEqual(triangles, { id: "a", ...surface(rounded, { show: "triangles", spacing: 0 }) });
  assert.equal(openSides(triangles), 0);
  assert.deepEqual(cells, { id: 7, ...surface({ lon, lat }) });
  assert.deepEqual([error.id, error.error.name, error.error.index], [8, "RondelError", 1]);
  assert.equal(nothing.error.name, "TypeError");
});

test("sites stay in a worker and are drawn again", async (t) => {
  const rondel = await startWorker();
  t.after(() => rondel.stop());
  const pairs = inputs.few;
  const sites = await rondel.sites(places(pairs));
  assert.equal(sites.numSites, 12);
  assert.deepEqual(await sites.drawn({ show: "cells" }), surface(places(pairs)));
  assert.deepEqual(await sites.drawn({ show: "triangles", spacing: 5 }), surface(places(pairs), { show: "triangles", spacing: 5 }));
  const xyz = unitVectors(pairs.flat());
  const [query] = [unitVectors([33, 44])];
  const nearest = pairs.map((_, i) => dot(query, point(xyz, i))).reduce((best, d, i, all) => (d > all[best] ? i : best), 0);
  assert.equal(await sites.nearest(33, 44), nearest);
  await sites.free();
  await assert.rejects(rondel.sites({ lon: [0], lat: [100] }), { name: "RondelError", index: 0 });
});
