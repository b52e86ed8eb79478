// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The worker gives what the functions give.

import assert from "node:assert/strict";
import { test } from "node:test";
import { delaunay, RondelError, voronoi } from "rondel";
import { triangulate } from "rondel/polygons";
import { RondelWorker, startWorker } from "rondel/worker";
import { engine } from "../node_modules/rondel/src/engine.js";
import { serve } from "../node_modules/rondel/src/worker/serve.js";
import { spawnThread } from "../node_modules/rondel/src/worker/threads.js";
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

/** A connection that serves requests here, and lists them. */
function localConnection() {
  const posted = [];
  let handle;
  let fail;
  return {
    posted,
    failWith: (reason) => fail(reason),
    post: (message) => {
      posted.push(message);
      if (message.method !== "dynamic") serve(message, (reply) => handle(reply));
    },
    listen: (...given) => ([handle, fail] = given),
    stop: async () => {},
  };
}

const collected = async (isDone) => {
  for (let i = 0; i < 50 && !isDone(); ++i) {
    globalThis.gc();
    await new Promise((resolve) => setTimeout(resolve, 1));
  }
};

test("a result that nothing refers to is freed in the worker", { skip: globalThis.gc === undefined }, async () => {
  const connection = localConnection();
  const rondel = new RondelWorker(connection);
  const freed = () => connection.posted.filter(({ method }) => method === "free").length;
  const xyz = randomSites(50, 4);
  await rondel.voronoi(xyz);
  await rondel.delaunay(xyz);
  const { nearest } = await rondel.delaunay(xyz); // a method alone keeps its object
  const kept = await rondel.voronoi(xyz);
  await (await rondel.voronoi(xyz)).free(); // once
  await collected(() => freed() === 3);
  assert.equal(freed(), 3);
  assert.equal((await nearest([0, 0, 1])).length, 1);
  assert.equal((await kept.nearest([0, 0, 1])).length, 1);
  assert.equal(freed(), 3);
});

test("what a worker cannot describe it does not keep", async () => {
  const owner = engine();
  const { functions } = owner;
  let numFreed = 0;
  owner.functions = {
    ...functions,
    rondel_diagram_create: () => 3, // out of memory
    rondel_triangulation_free: (place) => {
      ++numFreed;
      functions.rondel_triangulation_free(place);
    },
  };
  let reply;
  try {
    await serve({ id: 1, object: 0, method: "voronoi", args: [randomSites(50, 5)] }, (given) => (reply = given));
  } finally {
    owner.functions = functions;
  }
  assert.equal(reply.error.name, "RangeError");
  assert.equal(numFreed, 1);
});

test("a worker that fails rejects what waits for it, and what comes later", async () => {
  const connection = localConnection();
  const rondel = new RondelWorker(connection);
  const diagram = await rondel.voronoi(randomSites(20, 6));
  const waiting = rondel.dynamic();
  connection.failWith("it ended");
  await assert.rejects(waiting, { name: "Error", message: "the worker failed: it ended" });
  await assert.rejects(rondel.delaunay([1, 0, 0]), /the worker failed/);
  await assert.rejects(diagram.nearest([1, 0, 0]), /the worker failed/);
  await rondel.stop();
});

test("a worker that cannot be loaded fails", async () => {
  const rondel = new RondelWorker(spawnThread(new URL("./no_such_file.mjs", import.meta.url)));
  await assert.rejects(rondel.delaunay([1, 0, 0]), /the worker failed: .*no_such_file/);
  await assert.rejects(rondel.dynamic(), /the worker failed/);
  await rondel.stop();
});
