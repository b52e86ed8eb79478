// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The worker gives what the functions give.

import assert from "node:assert/strict";
import { test } from "node:test";
import { delaunay, RondelError, voronoi } from "rondel";
import { triangulate } from "rondel/polygons";
import { startWorker } from "rondel/worker";
import { randomSites } from "./support.mjs";

test("a worker answers as the functions do", async (t) => {
  const rondel = await startWorker();
  t.after(() => rondel.stop());
  const [xyz, queries] = [randomSites(500, 1), randomSites(20, 2)];

  const diagram = await rondel.voronoi(xyz);
  const here = voronoi(xyz);
  for (const name of ["triangles", "neighbors", "cells", "areas", "centers", "numFaces"]) {
    assert.deepEqual(diagram[name], here[name], name);
  }
  assert.equal(xyz.length, 1500); // what is passed is copied
  assert.deepEqual(await diagram.nearest(queries), here.nearest(queries));
  const [three, close] = await Promise.all([diagram.kNearest(queries, 3), diagram.within(queries, 0.2)]);
  assert.deepEqual(three, here.kNearest(queries, 3));
  assert.deepEqual(close, here.within(queries, 0.2));
  assert.deepEqual(await diagram.locate(queries), here.locate(queries));
  await diagram.free();
  await assert.rejects(diagram.nearest(queries));

  const weighted = await rondel.delaunay(xyz, { model: "weighted" });
  assert.deepEqual(weighted.triangles, delaunay(xyz, { model: "weighted" }).triangles);
  await weighted.free();
});

test("a worker fills polygons", async (t) => {
  const rondel = await startWorker();
  t.after(() => rondel.stop());
  const box = { type: "Polygon", coordinates: [[[170, 60], [190, 60], [190, 90], [170, 90], [170, 60]]] };
  assert.deepEqual(await rondel.triangulate(box, { spacing: 5 }), triangulate(box, { spacing: 5 }));
  await assert.rejects(rondel.triangulate({ type: "Circle" }), { name: "RondelError", index: 0 });
});

test("sites of a worker change", async (t) => {
  const rondel = await startWorker();
  t.after(() => rondel.stop());
  const dynamic = await rondel.dynamic(randomSites(100, 3));
  assert.deepEqual([...(await dynamic.insert([0, 0, 1]))], [100]);
  await dynamic.remove([3]);
  await dynamic.move([5], [0, 0, -1]);
  assert.equal((await dynamic.ids()).length, 100);
  assert.deepEqual([...(await dynamic.nearest([0, 0, -1]))], [5]);
  const snapshot = await dynamic.snapshot();
  assert.equal(snapshot.numSites, 100);
  assert.equal((await snapshot.nearest([0, 0, 1]))[0], 99);
  await assert.rejects(dynamic.remove([3]), (error) => error instanceof RondelError && error.index === 0);
  await assert.rejects(rondel.delaunay([1, 0, 0, NaN, 0, 0]), { name: "RondelError", index: 1 });
  await assert.rejects(rondel.delaunay("no"), TypeError);
});
