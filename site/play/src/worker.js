// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What runs in the worker: a triangulation whose sites come, go and move. It answers {method, argument} by {state} or {error},
// one after the other.
//
// Sites have keys, which the page gives them and which they keep when they are removed and come back. Arrays in a
// state are by key; keys without a site have no star and an empty ring.

import { polarPoints, unitVectors } from "../../../bindings/js/src/build.js";
import { DynamicTriangulation } from "../../../bindings/js/src/dynamic.js";
import { init } from "../../../bindings/js/src/engine.js";
import { noIndex } from "../../../bindings/js/src/located.js";

let dynamic = null;
let model = "projected";
let points = [];  // by key: [x, y, z], or null
let keyOfId = [];
let idOfKey = new Map();

// The sum with the rounding of each step kept apart (Neumaier 1974).
function sumOf(values) {
  let sum = 0;
  let lost = 0;
  for (const value of values) {
    const next = sum + value;
    lost += Math.abs(sum) >= Math.abs(value) ? sum - next + value : value - next + sum;
    sum = next;
  }
  return sum + lost;
}

function bind(ids, keys) {
  ids.forEach((id, i) => {
    keyOfId[id] = keys[i];
    idOfKey.set(keys[i], id);
  });
}

// All sites at once: `sites` by key as in `points`, or the table {lonLat, radii} or {xyz}.
function load({ sites, table, model: wanted }) {
  if (table?.radii) sites = triples(polarPoints(table.lonLat, table.radii));
  else if (table) sites = triples(table.xyz ?? unitVectors(table.lonLat));
  const keys = [...sites.keys()].filter((key) => sites[key] !== null);
  const next = new DynamicTriangulation(Float64Array.from(keys.flatMap((key) => sites[key])), { model: wanted });
  dynamic?.free();
  dynamic = next;
  model = wanted;
  points = sites;
  keyOfId = [];
  idOfKey = new Map();
  bind(keys.map((_, i) => i), keys);
}

function triples(array) {
  return Array.from({ length: array.length / 3 }, (_, i) => [array[3 * i], array[3 * i + 1], array[3 * i + 2]]);
}

const steps = {
  insert({ key, point }) {
    bind(dynamic.insert(point), [key]);
    while (points.length < key) points.push(null);
    points[key] = point;
  },
  move({ key, point }) {
    dynamic.move([idOfKey.get(key)], point);
    points[key] = point;
  },
  remove({ key }) {
    dynamic.remove([idOfKey.get(key)]);
    idOfKey.delete(key);
    points[key] = null;
  },
};

// Each site goes to the middle of its cell (Lloyd 1982), with the length that it has.
function relax() {
  const snapshot = dynamic.snapshot();
  const ids = dynamic.ids;
  const { centroids } = snapshot;
  snapshot.free();
  const moved = [];
  ids.forEach((id, i) => {
    const middle = [centroids[3 * i], centroids[3 * i + 1], centroids[3 * i + 2]];
    const site = points[keyOfId[id]];
    const length = Math.hypot(...site);
    if (Math.hypot(...middle) > 0) moved.push([keyOfId[id], middle.map((x) => x * length)]);
  });
  const next = [...points];
  for (const [key, point] of moved) next[key] = point;
  load({ sites: next, model });
}

// Rings by key, where they are not the faces around each site.
function ringsByKey(cells, keys, numKeys) {
  const ringOffsets = new Uint32Array(numKeys + 1);
  keys.forEach((key, i) => { ringOffsets[key + 1] = cells.offsets[i + 1] - cells.offsets[i]; });
  for (let key = 0; key < numKeys; ++key) ringOffsets[key + 1] += ringOffsets[key];
  const ringPoints = new Uint32Array(cells.rings.length);
  keys.forEach((key, i) => ringPoints.set(cells.rings.subarray(cells.offsets[i], cells.offsets[i + 1]), ringOffsets[key]));
  return { ringOffsets, ringPoints };
}

function directionsAndLengths(numKeys) {
  const directions = new Float64Array(3 * numKeys);
  const lengths = new Float64Array(numKeys);
  points.forEach((point, key) => {
    if (point === null) return;
    const largest = Math.max(...point.map(Math.abs));
    const scaled = point.map((x) => x / largest);
    const length = Math.hypot(...scaled);
    scaled.forEach((x, k) => { directions[3 * key + k] = x / length; });
    lengths[key] = length * largest;
  });
  return model === "weighted" ? { directions, lengths } : { directions };
}

// The arrays of a `Surface`, and what the page says of them.
function describe() {
  const keys = Uint32Array.from(dynamic.ids, (id) => keyOfId[id]);
  const snapshot = dynamic.snapshot();
  const numKeys = points.length;
  const { cells, areas } = snapshot;
  const named = (sites) => sites.map((site) => (site === noIndex ? noIndex : keys[site]));
  const byKey = new Float64Array(numKeys);
  areas.forEach((area, i) => { byKey[keys[i]] = area; });
  const arrays = {
    ...directionsAndLengths(numKeys),
    faces: named(snapshot.triangles),
    ghosts: snapshot.ghostFaces,
    duplicates: named(snapshot.duplicates),
    hidden: snapshot.hidden.map((value, i) => (i % 2 === 0 ? keys[value] : value)),
    ring: named(snapshot.ring),
    exactPoints: cells.points,
    areas: byKey,
  };
  const isPlain = snapshot.dimension === 2 && cells.points.length === 3 * snapshot.numFaces;
  if (!isPlain) Object.assign(arrays, ringsByKey(cells, keys, numKeys));
  const about = {
    dimension: snapshot.dimension,
    model,
    sites: snapshot.numSites,
    keys: numKeys,
    vertices: snapshot.numVertices,
    faces: snapshot.numFaces,
    ghosts: snapshot.ghostFaces.length,
    duplicates: snapshot.duplicates.length / 2,
    hidden: snapshot.hidden.length / 2,
    areaSum: sumOf(areas),
    isPlain,
  };
  snapshot.free();
  return { about, arrays };
}

const methods = {
  async begin(bytes) {
    await init(bytes);
    load({ sites: [], model: "projected" });
  },
  load,
  relax,
  change(list) {
    for (const step of list) steps[step.what](step);
  },
};

// `points` come back where the worker made them.
async function answer({ method, argument }) {
  const begin = performance.now();
  await methods[method](argument);
  const middle = performance.now();
  const state = describe();
  state.times = { change: middle - begin, diagram: performance.now() - middle };
  if (method === "load" || method === "relax") state.points = points;
  postMessage({ state }, Object.values(state.arrays).map((array) => array.buffer));
}

onmessage = ({ data }) => answer(data).catch(({ message, index }) => {
  postMessage({ error: { message, index } });
});
