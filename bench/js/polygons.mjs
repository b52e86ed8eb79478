// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Processor time in Node.js to triangulate the countries of npm's world-atlas at 1:110m, 1:50m and 1:10m, that of the
// first call and medians of 7 later runs in turns, after scripts/build-js and
// `npm install earcut world-atlas topojson-client --prefix FOLDER`:
//
//     node bench/js/polygons.mjs FOLDER/node_modules
//
// earcut triangulates each polygon in the plane of longitude and latitude, which is what three-globe and its like call;
// Rondel all of them on the sphere, with edges as RFC 7946 has them (`lonlat`: sides are divided until they are arcs) and
// with the same corners alone (`geodesic`). Both get GeoJSON, moved by a random angle in each turn.

import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const folder = new URL(`${pathToFileURL(process.argv[2]).href}/`);
const load = (path) => import(new URL(path, folder).href);
const { default: earcut, flatten } = await load("earcut/src/earcut.js");
const { feature } = await load("topojson-client/src/index.js");
const { triangulate } = await import(new URL("../../build/js/node_modules/rondel/src/polygons/index.js", import.meta.url).href);

/** Milliseconds of processor time. */
function cost(work) {
  const before = process.cpuUsage();
  const result = work();
  const { user, system } = process.cpuUsage(before);
  return { ms: (user + system) / 1000, result };
}

const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

/** Turned around the axis by an angle, where that keeps longitudes within a turn. */
function moved(collection, degrees) {
  const turn = (positions) => (typeof positions[0] === "number" ? [positions[0] + degrees, positions[1]] : positions.map(turn));
  return {
    type: "FeatureCollection",
    features: collection.features.map((f) => ({
      type: "Feature",
      properties: {},
      geometry: { type: f.geometry.type, coordinates: turn(f.geometry.coordinates) },
    })),
  };
}

function byEarcut(collection) {
  let triangles = 0;
  for (const { geometry } of collection.features) {
    const polygons = geometry.type === "Polygon" ? [geometry.coordinates] : geometry.coordinates;
    for (const rings of polygons) {
      const { vertices, holes, dimensions } = flatten(rings);
      triangles += earcut(vertices, holes, dimensions).length / 3;
    }
  }
  return triangles;
}

for (const scale of ["110m", "50m", "10m"]) {
  const topology = JSON.parse(readFileSync(new URL(`world-atlas/countries-${scale}.json`, folder)));
  const countries = feature(topology, topology.objects.countries);
  countries.features = countries.features.filter((f) => f.geometry);
  const works = {
    earcut: byEarcut,
    lonlat: (c) => triangulate(c, { invalid: "repair" }).triangles.length / 3,
    geodesic: (c) => triangulate(c, { invalid: "repair", edges: "geodesic" }).triangles.length / 3,
  };
  const found = { earcut: [], lonlat: [], geodesic: [] };
  const counts = {};
  const first = {};
  const warm = scale === "10m" ? 2 : 10; // V8 compiles what is hot again in the first turns
  for (let turn = 0; turn < warm + 7; ++turn) {
    const input = moved(countries, 1e-3 * Math.random());
    for (const [name, work] of Object.entries(works)) {
      const { ms, result } = cost(() => work(input));
      first[name] ??= ms;
      if (turn >= warm) found[name].push(ms);
      counts[name] = result;
    }
  }
  const text = Object.entries(found).map(([name, values]) => {
    const ms = `${median(values).toFixed(1)} ms (${first[name].toFixed(0)} at first)`;
    return `${name} ${ms}, ${counts[name]} triangles`;
  });
  console.log(`1:${scale}: ${text.join("; ")}`);
}
