// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Color ramps.

import { shown } from "../arguments.js";
import { RondelError } from "../errors.js";

/** @typedef {string | readonly number[]} Color "#rrggbb", or red, green, blue and perhaps alpha, from 0 to 255 */

/** From dark blue to light yellow. @type {readonly Color[]} */
export const defaultColors = ["#172e61", "#265e8f", "#35909f", "#6fbf9c", "#c5dfa5", "#fbf5db"];

export const rampSize = 256;

/**
 * Returns red, green, blue and alpha from 0 to 255.
 * @param {Color} color
 * @param {string} what
 * @param {number} [index] of several
 * @returns {number[]}
 */
export function rgba(color, what, index = 0) {
  if (typeof color === "string" && /^#[0-9a-f]{6}$/i.test(color)) {
    return [1, 3, 5].map((k) => parseInt(color.slice(k, k + 2), 16)).concat(255);
  }
  const isPart = (/** @type {unknown} */ part) => typeof part === "number" && part >= 0 && part <= 255;
  const parts = Array.isArray(color) || ArrayBuffer.isView(color) ? Array.from(/** @type {any} */ (color)) : [];
  if ((parts.length === 3 || parts.length === 4) && parts.every(isPart)) return [...parts, 255].slice(0, 4);
  throw new RondelError(`${what} is ${shown(color)}, not "#rrggbb" or three or four numbers from 0 to 255`, index);
}

/**
 * Returns rampSize colors, four bytes each, that go evenly through the given ones.
 * @param {readonly Color[]} colors
 */
export function ramp(colors) {
  if (!Array.isArray(colors)) throw new TypeError(`colors: an array of colors is wanted, not ${shown(colors)}`);
  if (colors.length === 0) throw new RondelError("colors: at least one color is wanted", 0);
  const stops = Array.from(colors, (color, i) => rgba(color, `colors: element ${i}`, i));
  const bytes = new Uint8Array(4 * rampSize);
  for (let i = 0; i < rampSize; ++i) {
    const place = (i / (rampSize - 1)) * (stops.length - 1);
    const k = Math.min(Math.floor(place), stops.length - 2);
    const [from, to] = k < 0 ? [stops[0], stops[0]] : [stops[k], stops[k + 1]];
    const t = k < 0 ? 0 : place - k;
    for (let part = 0; part < 4; ++part) bytes[4 * i + part] = Math.round(from[part] + t * (to[part] - from[part]));
  }
  return bytes;
}

/**
 * Returns the least and the largest value that is a number; 0 and 1 without any.
 * @param {ArrayLike<number>} values
 * @returns {[number, number]}
 */
export function extent(values) {
  let [low, high] = [Infinity, -Infinity];
  for (let i = 0; i < values.length; ++i) {
    if (values[i] < low) low = values[i];
    if (values[i] > high && values[i] < Infinity) high = values[i];
  }
  return low <= high ? [low, high] : [0, 1];
}
