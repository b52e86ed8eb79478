// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What layers for web maps do before anything is drawn; browser/layers_test.py looks at pictures.

import assert from "node:assert/strict";
import { test } from "node:test";
import { SphereLayer, SphereSites } from "rondel/maplibre";
import { extent, ramp, rampSize } from "../node_modules/rondel/src/layers/colors.js";
import { dot, randomLonLat } from "./support.mjs";

const radians = Math.PI / 180;
const pairs = randomLonLat(500, 11);
const places = { lon: pairs.map(([lon]) => lon), lat: pairs.map(([, lat]) => lat) };
const values = pairs.map(([, lat]) => lat);

async function opened(t, options) {
  const sites = await SphereSites.open(options);
  t.after(() => sites.close());
  return sites;
}

test("colors go evenly through the given ones", () => {
  const bytes = ramp(["#000000", [255, 0, 0, 128], "#ffffff"]);
  assert.equal(bytes.length, 4 * rampSize);
  assert.deepEqual([...bytes.slice(0, 4), ...bytes.slice(-4)], [0, 0, 0, 255, 255, 255, 255, 255]);
  for (let i = 1; i < rampSize; ++i) assert.ok(bytes[4 * i] >= bytes[4 * i - 4]);
  assert.ok(Math.abs(bytes[4 * 64] - 128) < 2 && bytes[4 * 64 + 1] === 0);
  assert.deepEqual([...ramp(["#102030"]).slice(0, 8)], [16, 32, 48, 255, 16, 32, 48, 255]);
  for (const bad of [[], ["red"], ["#12345"], [[0, 0]], [[0, 0, 256]], [[0, 0, NaN]]]) {
    assert.throws(() => ramp(bad), { name: "RondelError", index: 0 });
  }
  assert.deepEqual(extent([3, NaN, -1, Infinity]), [-1, 3]);
  assert.deepEqual(extent([NaN]), [0, 1]);
});

test("the site at a place is the nearest one, and has its value", async (t) => {
  const sites = await opened(t, { ...places, values });
  const vector = ([lon, lat]) => [
    Math.cos(lat * radians) * Math.cos(lon * radians),
    Math.cos(lat * radians) * Math.sin(lon * radians),
    Math.sin(lat * radians),
  ];
  for (const place of [[0, 90], [180, -89], [-180, 3], [179.9, 3], [12, 50]]) {
    const near = (i) => dot(vector(place), vector(pairs[i]));
    const best = pairs.reduce((found, _, i) => (near(i) > near(found) ? i : found), 0);
    assert.deepEqual(await sites.at(...place), { site: best, value: values[best], lon: pairs[best][0], lat: pairs[best][1] });
  }
  await assert.rejects(sites.at(0, 100), { name: "RondelError" });
});

test("sites keep what was drawn last, and nothing that failed", async (t) => {
  const sites = await opened(t, { ...places, values });
  const first = sites.drawn({ show: "triangles", spacing: 0 });
  const wrong = () => sites.drawn({ show: "cells", spacing: 1e-9 });
  const failed = wrong();
  await assert.rejects(failed);
  const again = wrong();
  assert.notEqual(again, failed);
  await assert.rejects(again);
  for (let i = 0; i < 20; ++i) {
    sites.drawn({ show: "isolines", levels: [i] });
    if (i < 10) assert.equal(sites.drawn({ show: "triangles", spacing: 0 }), first);
  }
  assert.equal(sites.drawn({ show: "isolines", levels: [19] }), sites.drawn({ show: "isolines", levels: [19] }));
  for (let i = 20; i < 40; ++i) await sites.drawn({ show: "isolines", levels: [i] });
  assert.notEqual(sites.drawn({ show: "triangles", spacing: 0 }), first);
});

test("layers that show the same share it, and isolines follow the values", async (t) => {
  const sites = await opened(t, { ...places, values });
  const [one, two] = [sites.drawn({ show: "cells" }), sites.drawn({ show: "cells" })];
  assert.equal(one, two);
  const lines = (await sites.drawn({ show: "isolines", levels: [0] })).segments.length;
  let told = 0;
  const stop = sites.onChange(() => ++told);
  sites.setValues(values.map(() => 1));
  stop();
  sites.setValues(values.map(() => 2));
  assert.equal(told, 1);
  assert.ok(lines > 0);
  assert.equal((await sites.drawn({ show: "isolines", levels: [0] })).segments.length, 0);
  assert.equal(sites.drawn({ show: "cells" }), one);
});

test("what is wrong is told before anything is drawn", async (t) => {
  await assert.rejects(SphereSites.open({ lon: [0, 1], lat: [0, 91] }), { name: "RondelError", index: 1 });
  await assert.rejects(SphereSites.open({ lon: [0, 1], lat: [0] }), { name: "RondelError", index: 1 });
  await assert.rejects(SphereSites.open({ lon: [0], lat: [0], values: [1, 2] }), { name: "RondelError", index: 1 });
  const sites = await opened(t, places);
  assert.ok(sites.values.every(Number.isNaN));
  assert.throws(() => sites.setValues([1]), { name: "RondelError" });
  const layer = (options) => new SphereLayer({ id: "x", sites, ...options });
  for (const [options, message, index] of [
    [{ sites: undefined }, /^sites: /],
    [{ sites: places }, /^sites: /],
    [{ show: "isolines" }, /^levels: /],
    [{ show: "hexagons" }, /^show is "hexagons"/, 0],
    [{ colors: ["#000000", "red"] }, /^colors: element 1 is "red"/, 1],
    [{ lineColor: "black" }, /^lineColor is "black"/, 0],
    [{ domain: [0, NaN] }, /^domain: element 1 is NaN/, 1],
  ]) {
    const expected = index === undefined ? { name: "TypeError", message } : { name: "RondelError", message, index };
    assert.throws(() => layer(options), expected);
  }
  const good = layer({ show: "isolines", levels: [1] });
  await good.loaded;
  assert.throws(() => good.setOptions({ colors: [] }), { name: "RondelError" });
});
