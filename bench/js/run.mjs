// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Processor time (all threads of the process) in Node.js, medians of runs in turns, after scripts/build-js:
//
//     node bench/js/run.mjs [NATIVE_BENCH]
//
// 1. d3-geo-voronoi and Rondel, 2^14 uniform sites in longitude and latitude: Rondel's typed arrays (triangles,
//    neighbors, cells), and polygons() of the drop-in, against what d3's geoDelaunay() always makes, and its polygons().
// 2. The module and native_bench, 2^17 sites: build, and diagram without the copies to JavaScript; in turns of several
//    runs each, and the median of the turns' ratios.

import { execFileSync } from "node:child_process";
import { cpus } from "node:os";

const folder = new URL("../../build/js/node_modules/", import.meta.url);
const load = (path) => import(new URL(path, folder).href);
const [rondel, d3, { engine }] = await Promise.all([
  load("rondel/src/index.js"),
  load("d3-geo-voronoi/src/index.js"),
  load("rondel/src/engine.js"),
]);
const { build } = await load("rondel/src/build.js");
const { VoronoiDiagram } = await load("rondel/src/triangulation.js");

/** The sites of native_bench.cpp. @param {number} n */
function uniformSites(n) {
  let state = 48271;
  const next = () => (state = (state * 48271) % 2147483647) / 2147483647;
  const xyz = new Float64Array(3 * n);
  for (let i = 0; i < n; ++i) {
    const [z, angle] = [2 * next() - 1, 2 * Math.PI * next()];
    const r = Math.sqrt(1 - z * z);
    xyz.set([r * Math.cos(angle), r * Math.sin(angle), z], 3 * i);
  }
  return xyz;
}

/** Milliseconds of processor time. @param {() => unknown} work */
function cost(work) {
  const before = process.cpuUsage();
  work();
  const { user, system } = process.cpuUsage(before);
  return (user + system) / 1e3;
}

/** Medians of each, run in turns. @param {Record<string, () => unknown>} works @param {number} runs */
function medians(works, runs) {
  const costs = Object.fromEntries(Object.keys(works).map((name) => [name, []]));
  for (let i = 0; i < runs; ++i) for (const [name, work] of Object.entries(works)) costs[name].push(cost(work));
  const middle = (values) => values.sort((a, b) => a - b)[values.length >> 1];
  return Object.fromEntries(Object.entries(costs).map(([name, values]) => [name, middle(values)]));
}

function againstD3() {
  const xyz = uniformSites(2 ** 14);
  const degrees = 180 / Math.PI;
  const points = Array.from({ length: 2 ** 14 }, (_, i) => [
    Math.atan2(xyz[3 * i + 1], xyz[3 * i]) * degrees,
    Math.asin(xyz[3 * i + 2]) * degrees,
  ]);
  const flat = Float64Array.from(points.flat());
  return medians(
    {
      "d3 geoDelaunay": () => d3.geoDelaunay(points),
      "d3 polygons": () => d3.geoVoronoi(points).polygons(),
      "Rondel typed arrays": () => {
        const diagram = rondel.voronoi.lonLat(flat);
        const result = [diagram.triangles, diagram.neighbors, diagram.cells];
        diagram.free();
        return result;
      },
      "Rondel drop-in polygons": () => rondel.geoVoronoi(points).polygons(),
    },
    9,
  );
}

/** Medians of some runs of the module. @param {Float64Array} xyz */
function inModule(xyz) {
  const owner = engine();
  let triangulation;
  return medians(
    {
      build: () => (triangulation = build(VoronoiDiagram, owner, xyz, {})),
      diagram: () =>
        owner.scoped((scope) => {
          owner.functions.rondel_diagram_free(scope.made("rondel_diagram_create", triangulation.handle.place, 0));
          triangulation.free();
        }),
    },
    7,
  );
}

/** @param {string} program native_bench */
function againstNative(program) {
  const xyz = uniformSites(2 ** 17);
  inModule(xyz); // compiled by all of the engine's compilers from now on
  const turns = Array.from({ length: 9 }, () => ({
    native: JSON.parse(execFileSync(program, [String(2 ** 17), "7"], { encoding: "utf8" })),
    wasm: inModule(xyz),
  }));
  for (const name of ["build", "diagram"]) {
    const sorted = (values) => values.sort((x, y) => x - y);
    const ratios = sorted(turns.map(({ native, wasm }) => wasm[name] / native[name]));
    const [native, wasm] = ["native", "wasm"].map((kind) => sorted(turns.map((turn) => turn[kind][name]))[4]);
    const [least, middle, most] = [ratios[0], ratios[4], ratios[8]].map((ratio) => ratio.toFixed(2));
    console.log(`${name}: native ${native.toFixed(1)}, wasm ${wasm.toFixed(1)}, ratio ${middle} (${least} to ${most})`);
  }
}

console.log(`${cpus()[0].model}, Node.js ${process.version}; milliseconds of processor time`);
const d = againstD3();
console.table(d);
console.log(`typed arrays: ${(d["d3 geoDelaunay"] / d["Rondel typed arrays"]).toFixed(1)} times faster than geoDelaunay`);
console.log(`polygons(): ${(d["d3 polygons"] / d["Rondel drop-in polygons"]).toFixed(1)} times faster`);
if (process.argv[2]) againstNative(process.argv[2]);
