// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites for the examples: random, denser in the north, with one at each pole; the values are a smooth field.

/** Numbers in [0, 1), the same each time (Lehmer's generator). */
function randomNumbers() {
  let state = 48271;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

const radians = Math.PI / 180;

/** The field, from about -1 to 1, at a longitude and a latitude in degrees. */
export function fieldAt(lon, lat) {
  return Math.sin(3 * lon * radians) * Math.cos(lat * radians) ** 3 + 0.5 * Math.sin(2 * lat * radians);
}

/** n sites {lon, lat, values}. */
export function makeField(n) {
  const random = randomNumbers();
  const lon = new Float64Array(n);
  const lat = new Float64Array(n);
  for (let i = 0; i < n; ++i) {
    lon[i] = 360 * random() - 180;
    lat[i] = i < 2 ? 90 - 180 * i : Math.asin(1 - 2 * random() ** 1.3) / radians;
  }
  return { lon, lat, values: Float64Array.from(lon, (x, i) => fieldAt(x, lat[i])) };
}
