// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// triangulate() and geoTriangulate(): triangles have the areas of polygons and the sides of these as borders.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { geoArea } from "d3-geo";
import { RondelError, unitVectors } from "rondel";
import { geoTriangulate, triangulate } from "rondel/polygons";
import { engine } from "../node_modules/rondel/src/polygons/engine.js";
import { wideOffsets } from "../node_modules/rondel/src/polygons/triangulate.js";
import { cross, difference, dot, point, sum } from "./support.mjs";

const data = (name) => JSON.parse(readFileSync(join(process.env.RONDEL_SOURCE_DIR, "data", name), "utf8"));
const countries = data("countries-110m.geojson");
const polygon = (...coordinates) => ({ type: "Polygon", coordinates });
const box = (w, s, e, n) => [[w, s], [e, s], [e, n], [w, n], [w, s]];
const area = (a, b, c) =>
  2 * Math.atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a)); // Oosterom and Strackee

/** The corners of each triangle of a feature. */
function* trianglesIn({ points, triangles, offsets }, feature) {
  for (let t = offsets[feature]; t < offsets[feature + 1]; ++t) {
    yield [0, 1, 2].map((i) => point(points, triangles[3 * t + i]));
  }
}

const areaOf = (made, feature = 0) => sum([...trianglesIn(made, feature)].map((corners) => area(...corners)));

/** The area between the equator and straight lines in longitude and latitude, by Green's theorem. */
function lonLatArea(rings) {
  const degree = Math.PI / 180;
  const antiderivative = (p, q) => {
    const [a, b] = [p[1] * degree, q[1] * degree];
    const mean = Math.abs(b - a) < 1e-9 ? Math.sin((a + b) / 2) : (Math.cos(a) - Math.cos(b)) / (b - a);
    return -(q[0] - p[0]) * degree * mean;
  };
  const of = (ring) => Math.abs(sum(ring.slice(1).map((q, i) => antiderivative(ring[i], q))));
  return of(rings[0]) - sum(rings.slice(1).map(of));
}

/** How far the area of arcs may be from that of straight lines, which they follow within 0.0001 degrees. */
const allowance = (rings) => {
  const lengths = rings.map((ring) => sum(ring.slice(1).map((q, i) => Math.hypot(q[0] - ring[i][0], q[1] - ring[i][1]))));
  return (1e-4 * sum(lengths) * Math.PI ** 2) / 180 ** 2 + 1e-12;
};

const polygonsOf = ({ type, coordinates }) => (type === "Polygon" ? [coordinates] : coordinates);

/** The directed sides of a feature's triangles that are in one of them alone. */
function border({ triangles, offsets }, feature = 0) {
  const sides = new Set();
  for (let t = 3 * offsets[feature]; t < 3 * offsets[feature + 1]; t += 3) {
    for (let i = 0; i < 3; ++i) {
      const side = `${triangles[t + i]},${triangles[t + ((i + 1) % 3)]}`;
      assert.ok(!sides.has(side), "a side has one triangle on its left");
      sides.add(side);
    }
  }
  return [...sides].map((side) => side.split(",").map(Number)).filter(([a, b]) => !sides.has(`${b},${a}`));
}

for (const spacing of [0, 3]) {
  test(`all countries are filled, with a spacing of ${spacing}`, () => {
    const made = triangulate(countries, { spacing });
    assert.equal(made.offsets.length, countries.features.length + 1);
    countries.features.forEach(({ geometry }, f) => {
      const expected = sum(polygonsOf(geometry).map(lonLatArea));
      const allowed = sum(polygonsOf(geometry).map(allowance));
      assert.ok(Math.abs(areaOf(made, f) - expected) <= allowed, `feature ${f}`);
      for (const [a, b, c] of trianglesIn(made, f)) assert.ok(dot(a, cross(b, c)) > 0);
    });
  });
}

test("borders of triangles are sides of the polygon", () => {
  const rings = [box(0, 0, 40, 40), box(10, 10, 20, 20).reverse()];
  const made = triangulate(polygon(...rings), { edges: "geodesic" });
  assert.equal(made.points.length / 3, 8);
  const corners = rings.map((ring) => unitVectors(ring.flat()));
  const sides = new Set(
    corners.flatMap((ring) => [0, 1, 2, 3].map((i) => `${point(ring, i)} ${point(ring, i + 1)}`)),
  );
  const found = border(made).map(([a, b]) => `${point(made.points, a)} ${point(made.points, b)}`);
  assert.deepEqual(new Set(found), sides);
});

test("poles, the antimeridian and more than a hemisphere", () => {
  const cap = triangulate(polygon([[0, 80], [120, 80], [-120, 80], [0, 80]]), { edges: "geodesic" });
  assert.equal(cap.triangles.length, 3);
  const across = triangulate(polygon(box(170, -10, 190, 10)));
  const cut = triangulate({
    type: "MultiPolygon",
    coordinates: [[box(170, -10, 180, 10)], [box(-180, -10, -170, 10)]],
  });
  assert.ok(Math.abs(areaOf(across) - areaOf(cut)) < 1e-12);
  const large = polygon(box(-180, -90, 180, 80), box(-20, -20, 20, 20));
  const expected = lonLatArea(large.coordinates);
  for (const spacing of [0, 10]) {
    const made = triangulate(large, { spacing });
    assert.ok(Math.abs(areaOf(made) - expected) < 1e-5);
    assert.equal(border(made).every(([a, b]) => made.points[3 * a + 2] !== 0 || made.points[3 * b + 2] !== 0), true);
  }
});

test("a spacing divides what is longer", () => {
  const made = triangulate(polygon(box(0, 40, 60, 80)), { spacing: 4 });
  const lengths = [...trianglesIn(made, 0)].flatMap((corners) =>
    corners.map((p, i) => {
      const gap = difference(p, corners[(i + 1) % 3]);
      return (2 * Math.asin(Math.sqrt(dot(gap, gap)) / 2) * 180) / Math.PI;
    }),
  );
  assert.ok(Math.max(...lengths) < 8);
  assert.ok(lengths.length > 300);
  for (const spacing of [-1, NaN, Infinity, 1e-9]) {
    assert.throws(() => triangulate(polygon(box(0, 0, 1, 1)), { spacing }), /spacing/);
  }
});

test("kinds of objects, and what has no inside", () => {
  const square = polygon(box(0, 0, 1, 1));
  const feature = { type: "Feature", properties: {}, geometry: square };
  const many = { type: "FeatureCollection", features: [feature, { ...feature, geometry: null }, feature] };
  const collection = { type: "GeometryCollection", geometries: [{ type: "Point", coordinates: [5, 5] }, square] };
  const one = triangulate(square);
  for (const object of [feature, collection, { type: "MultiPolygon", coordinates: [square.coordinates] }]) {
    assert.deepEqual(triangulate(object), one);
  }
  const made = triangulate(many);
  const [, first, second, third] = made.offsets;
  assert.deepEqual([...made.offsets], [0, first, first, 2 * first]);
  assert.equal(second, first);
  assert.equal(third, 2 * second);
  for (const object of [many.features[1], { type: "LineString", coordinates: [[0, 0], [1, 1]] }, polygon()]) {
    assert.equal(triangulate(object).triangles.length, 0);
  }
});

test("neighbors have the same edges, and overlapping ones are divided", () => {
  const made = triangulate({
    type: "FeatureCollection",
    features: [polygon(box(0, 0, 10, 10)), polygon(box(10, 0, 20, 10)), polygon(box(5, 5, 15, 15))],
  });
  const [left, right] = [0, 1].map((f) => border(made, f));
  const shared = left.filter(([a, b]) => right.some(([c, d]) => a === d && b === c));
  assert.ok(shared.length > 1);
  [0, 1, 2].forEach((f) => {
    const alone = triangulate([polygon(box(0, 0, 10, 10)), polygon(box(10, 0, 20, 10)), polygon(box(5, 5, 15, 15))][f]);
    assert.ok(Math.abs(areaOf(made, f) - areaOf(alone)) < 1e-9);
  });
});

test("errors name the feature", () => {
  const good = polygon(box(0, 0, 1, 1));
  const bow = polygon([[0, 0], [2, 2], [2, 0], [0, 2], [0, 0]]);
  const in_collection = (geometry) => ({
    type: "FeatureCollection",
    features: [good, { type: "Feature", properties: null, geometry }],
  });
  for (const [geometry, reason] of [
    [{ type: "Polygon", coordinates: [[[0, 0], [1, 95], [1, 0], [0, 0]]] }, /latitude 95/],
    [{ type: "Polygon", coordinates: [[[0, 0], ["1", 9], [1, 0], [0, 0]]] }, /is no \[longitude, latitude\]/],
    [{ type: "Polygon", coordinates: 7 }, /array of rings/],
    [{ type: "Circle" }, /"Circle" is no geometry/],
    [{ type: "Sphere" }, /Sphere/],
    [polygon(box(0, 0, 1, 1).slice(0, 4)), /not closed/],
  ]) {
    assert.throws(
      () => triangulate(in_collection(geometry)),
      (error) => error instanceof RondelError && error.index === 1 && reason.test(error.message),
    );
  }
  assert.throws(() => triangulate(bow, { edges: "geodesic" }), /crosses itself/);
  assert.equal(triangulate(bow, { edges: "geodesic", invalid: "repair" }).triangles.length, 6);
  assert.throws(() => triangulate(good, { edges: "straight" }), /edges is "straight", not one of "lonlat", "geodesic"$/);
  assert.throws(() => triangulate(good, { invalid: "keep" }), /invalid is "keep"/);
  for (const object of [null, 3, { type: "FeatureCollection" }]) assert.throws(() => triangulate(object), TypeError);
});

test("geoTriangulate reads polygons as d3-geo does", () => {
  const clockwise = polygon(box(0, 0, 40, 40).reverse(), box(10, 10, 20, 20));
  const others = polygon(box(0, 0, 40, 40));
  for (const object of [clockwise, others, polygon(box(-170, -80, 170, 80).reverse()), { type: "Sphere" }]) {
    for (const spacing of [0, 8]) {
      const { points, triangles, features } = geoTriangulate(object, { spacing });
      assert.equal(features.length, 1);
      assert.equal(features[0].length, triangles.length);
      const xyz = unitVectors(points.flat());
      const total = sum(triangles.map((corners) => area(...corners.map((k) => point(xyz, k)))));
      assert.ok(Math.abs(total - geoArea(object)) < 1e-9, `${total} ${geoArea(object)}`);
    }
  }
  const { points, triangles } = geoTriangulate(clockwise);
  assert.equal(points.length, 8);
  assert.equal(triangles.length, 8);
  assert.ok(points.every((p) => clockwise.coordinates.flat().some((q) => p[0] === q[0] && p[1] === q[1])));
  const bow = polygon([[0, 0], [2, 2], [2, 0], [0, 2], [0, 0]]);
  assert.throws(() => geoTriangulate(bow), /do not divide in and out/);
  const open = polygon([[0, 0], [0, 10], [10, 10], [10, 0]]);
  assert.throws(() => geoTriangulate(open), { name: "RondelError", message: "feature 0: a ring is not closed" });
  assert.deepEqual(geoTriangulate(polygon()), { points: [], triangles: [], features: [[]] });
});

test("triangles have the bytes that are recorded", () => {
  const recorded = readFileSync(join(process.env.RONDEL_SOURCE_DIR, "tests/same_bytes/expected_overlay.txt"), "utf8");
  for (const spacing of [0, 2]) {
    const { points, triangles, offsets } = triangulate(countries, { spacing });
    let hash = 0xcbf29ce484222325n; // tests/same_bytes/portable/hash.h
    const add = (words, count) => {
      for (const word of [count, ...words]) hash = BigInt.asUintN(64, (hash ^ BigInt(word)) * 0x100000001b3n);
    };
    add([...offsets].flatMap((offset) => [offset, 0]), offsets.length);
    add(triangles, triangles.length);
    add(new Uint32Array(points.buffer), points.length);
    const text = hash.toString(16).padStart(16, "0");
    assert.ok(recorded.includes(`countries triangles-${spacing} ${text}\n`), text);
  }
});

const octant = polygon([[0, 0], [0, 90], [90, 0], [0, 0]]);
const collection = (...geometries) => ({
  type: "FeatureCollection",
  features: geometries.map((geometry) => ({ type: "Feature", geometry })),
});

test("a Sphere in a collection is the whole sphere", () => {
  const both = { type: "GeometryCollection", geometries: [{ type: "Sphere" }, octant] };
  const { features } = geoTriangulate(collection(null, both, octant));
  const alone = geoTriangulate(collection(null, { type: "Sphere" }, octant)).features;
  assert.deepEqual(features, alone);
  assert.deepEqual(features.map((triangles) => triangles.length), [0, 8, 1]);
});

test("a side without a shortest way is named by its feature", () => {
  // Opposite up to rounding: the middle of three corners on one meridian is left out.
  const side = polygon([[10, 20], [-170, -20.000000000000004], [60, 0], [10, 20]]);
  for (const bad of [side, polygon([[0, 0], [180, 0], [60, 50], [0, 0]])]) {
    for (const spacing of [0, 10]) {
      try {
        geoTriangulate(collection(null, octant, bad, octant), { spacing });
      } catch (error) {
        assert.ok(error instanceof RondelError, String(error.stack));
        assert.equal(error.index, 2, error.message);
        assert.doesNotMatch(error.message, /constraint/);
      }
    }
  }
  assert.throws(() => geoTriangulate(collection(octant, polygon([[0, 0], [180, 0], [60, 50], [0, 0]]))), { index: 1 });
});

test("polygons that are to be the sphere must be there", () => {
  const owner = engine();
  for (const absent of [1, 0xffffffff]) {
    const make = () =>
      owner.scoped((scope) =>
        scope.made("rondel_polygons_create", scope.copy(wideOffsets([0, 0])), 1, 0, 0, scope.copy(Uint32Array.of(absent)), 1),
      );
    assert.throws(make, { name: "RondelError", message: /is not there/ });
  }
  const many = () =>
    owner.scoped((scope) => scope.made("rondel_polygons_create", scope.copy(Uint32Array.of(0, 0, 0, 1)), 1, 0, 0, 0, 0));
  assert.throws(many, { name: "RondelError", message: "polygons count more than can be", index: 1 });
});
