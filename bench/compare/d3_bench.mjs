// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// node d3_bench.mjs FILE.npy PACKAGES: d3-geo-voronoi's geoDelaunay of the sites in a file, from
// longitudes and latitudes in degrees. PACKAGES is the folder that holds node_modules. Repetition
// and memory as in bench/measure.h.

import {readFileSync, writeFileSync} from "node:fs";
import {join, resolve} from "node:path";
import {pathToFileURL} from "node:url";

const [, , file, packages] = process.argv;
const {geoDelaunay} = await import(pathToFileURL(findModule("d3-geo-voronoi")));

// The package is a module, which NODE_PATH does not find.
function findModule(name) {
  const folder = join(resolve(packages), "node_modules", name);
  const {module: entry} = JSON.parse(readFileSync(join(folder, "package.json")));
  return join(folder, entry);
}

function readSites(path) {
  const bytes = readFileSync(path);
  const start = 10 + bytes.readUInt16LE(8);
  const xyz = new Float64Array(bytes.buffer.slice(bytes.byteOffset + start));
  const degrees = 180 / Math.PI;
  const sites = [];
  for (let i = 0; i < xyz.length; i += 3) {
    const [x, y, z] = xyz.subarray(i, i + 3);
    sites.push([degrees * Math.atan2(y, x), degrees * Math.atan2(z, Math.hypot(x, y))]);
  }
  return sites;
}

function peakBytes() {
  return 1024 * Number(/VmHWM:\s*(\d+)/.exec(readFileSync("/proc/self/status", "ascii"))[1]);
}

const sites = readSites(file);
writeFileSync("/proc/self/clear_refs", "5");
const before = peakBytes();
let delaunay;

function run() {
  delaunay = undefined;
  const start = process.hrtime.bigint();
  delaunay = geoDelaunay(sites);
  return Number(process.hrtime.bigint() - start) / 1e9;
}

const first = run();
const memory = peakBytes() - before;
run();
const seconds = [];
let sum = 0;
while (sum < 0.25 || (seconds.length < 3 && sum < 8)) {
  seconds.push(run());
  sum += seconds.at(-1);
}
seconds.sort((a, b) => a - b);
console.log(JSON.stringify({
  sites: sites.length,
  vertices: new Set(delaunay.triangles.flat()).size,
  faces: delaunay.triangles.length,
  seconds: seconds[seconds.length >> 1],
  first_seconds: first,
  bytes_per_site: memory / sites.length,
}));
