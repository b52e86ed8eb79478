// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points for tests.

/** Numbers in [0, 1), the same each time (Lehmer's generator). @param {number} seed */
export function randomNumbers(seed) {
  let state = 48271 * (seed + 1);
  return () => {
    state = (state * 48271) % 2147483647;
    return state / 2147483647;
  };
}

/** n uniform points of the unit sphere, x, y, z one after the other. @param {number} n @param {number} seed */
export function randomSites(n, seed) {
  const random = randomNumbers(seed);
  const xyz = new Float64Array(3 * n);
  for (let i = 0; i < n; ++i) {
    const [z, angle] = [2 * random() - 1, 2 * Math.PI * random()];
    const r = Math.sqrt(1 - z * z);
    xyz.set([r * Math.cos(angle), r * Math.sin(angle), z], 3 * i);
  }
  return xyz;
}

/** n uniform points [longitude, latitude]. @param {number} n @param {number} seed */
export function randomLonLat(n, seed) {
  const random = randomNumbers(seed);
  return Array.from({ length: n }, () => [360 * random() - 180, (Math.asin(2 * random() - 1) * 180) / Math.PI]);
}

export const point = (xyz, i) => [xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const difference = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const sum = (values) => values.reduce((s, v) => s + v, 0);
