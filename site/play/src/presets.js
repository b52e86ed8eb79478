// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites to begin with: {xyz}, {lonLat} or {lonLat, radii}, all flat arrays, angles in degrees.

import { cross, directionOf, lonLatOf, perpendicular, plus, times } from "../../../viewer/src/vectors.js";

// Mulberry32: numbers from 0 to 1 that look random, the same for the same seed.
function randomNumbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let x = state;
    x = Math.imul(x ^ (x >>> 15), x | 1);
    x ^= x + Math.imul(x ^ (x >>> 7), x | 61);
    return ((x ^ (x >>> 14)) >>> 0) / 2 ** 32;
  };
}

function many(n, make) {
  return Array.from({ length: n }, (_, i) => make(i)).flat();
}

function uniform(n, random) {
  return many(n, () => lonLatOf(uniformPoint(random)));
}

function uniformPoint(random) {
  const z = 2 * random() - 1;
  const angle = 2 * Math.PI * random();
  const r = Math.sqrt(1 - z * z);
  return [r * Math.cos(angle), r * Math.sin(angle), z];
}

function spiral(n) {
  const step = Math.PI * (3 - Math.sqrt(5));
  return many(n, (i) => {
    const z = 1 - (2 * i + 1) / n;
    const r = Math.sqrt(1 - z * z);
    return [r * Math.cos(i * step), r * Math.sin(i * step), z];
  });
}

// Every meridian has its poles, so that 36 sites are in each of two places.
function grid() {
  return many(36, (i) => many(19, (j) => [10 * i - 180, 10 * j - 90]));
}

// Points of one circle, and exactly: for whole numbers a and b the point (a^2 - b^2, 2 a b, a^2 + b^2) is at 45 degrees
// of latitude. It need not be a unit vector, as a site is the direction of its point.
function onOneCircle(n) {
  const sites = new Map();
  for (let p = 2; sites.size < n; ++p) {
    for (let q = 1; q < p; ++q) {
      for (const [a, b] of [[p, q], [p, -q], [q, p], [q, -p]]) {
        const [x, y, z] = [a * a - b * b, 2 * a * b, a * a + b * b];
        if (sites.size < n) sites.set(`${x / z} ${y / z}`, [x, y, z]);
      }
    }
  }
  return [...sites.values()].flat();
}

// Within a circle of half a metre around a place.
function metre(n, random) {
  const middle = directionOf(2.2945, 48.8584);
  const u = perpendicular(middle);
  const v = cross(middle, u);
  return many(n, () => {
    const r = (0.5 / 6371008.8) * Math.sqrt(random());
    const angle = 2 * Math.PI * random();
    return plus(middle, plus(times(u, r * Math.cos(angle)), times(v, r * Math.sin(angle))));
  });
}

// Circles that cover a little more than the sphere, a few of them large.
function circles(n, random) {
  const typical = (180 / Math.PI) * Math.sqrt(2 / n);
  return { lonLat: uniform(n, random), radii: many(n, () => Math.min(80, typical * (0.3 + 1.9 * random() ** 3))) };
}

// `count`: whether the number of sites can be chosen.
export const presets = {
  spiral: { name: "Fibonacci spiral", count: true, make: (n) => ({ xyz: spiral(n) }) },
  random: { name: "Random", count: true, make: (n, random) => ({ lonLat: uniform(n, random) }) },
  circles: { name: "Circles: power diagram", count: true, make: circles },
  grid: { name: "10\u00b0 grid with its poles", make: () => ({ lonLat: grid() }) },
  circle: { name: "36 sites on one circle", make: () => ({ xyz: onOneCircle(36) }) },
  metre: { name: "500 sites within 1 m", make: (_, random) => ({ xyz: metre(500, random) }) },
  empty: { name: "Nothing", make: () => ({ xyz: [] }) },
};

export function presetTable(key, n, seed) {
  return presets[key].make(n, randomNumbers(seed));
}
