// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Round numbers that divide an interval into about so many parts, as d3-scale finds them by scaleLinear().domain([least,
// most]).nice().ticks(n).

/**
 * A step is 1, 2 or 5 times a power of ten: `times` / `over`, of which one is 1, so that multiples of a step below 1 are
 * quotients, which round correctly: 3 / 10, not 3 * 0.1.
 * @typedef {{times: number, over: number}} Step
 */

/**
 * The step whose ratio to the exact one, extent / n, is nearest to 1.
 * @param {number} extent
 * @param {number} n
 * @returns {Step}
 */
function stepOf(extent, n) {
  const exact = extent / n;
  const power = Math.floor(Math.log10(exact));
  const ratio = exact / 10 ** power;
  const factor = [50, 10, 2].findIndex((square) => ratio >= Math.sqrt(square));
  const digit = factor < 0 ? 1 : [10, 5, 2][factor];
  return power < 0 ? { times: 1, over: 10 ** -power / digit } : { times: digit * 10 ** power, over: 1 };
}

/** @param {Step} step @param {number} k */
const multiple = ({ times, over }, k) => (times * k) / over;

/** @param {Step} step @param {number} value */
const quotient = ({ times, over }, value) => (over === 1 ? value / times : value * over);

/**
 * The interval whose ends are multiples of its own step for ten parts.
 * @param {number} least
 * @param {number} most
 */
function widened(least, most) {
  const parts = 10;
  let [low, high, last] = [least, most, NaN];
  for (let round = 0; round < 10; ++round) {
    const step = stepOf(high - low, parts);
    if (multiple(step, 1) === last) return [low, high];
    last = multiple(step, 1);
    [low, high] = [multiple(step, Math.floor(quotient(step, low))), multiple(step, Math.ceil(quotient(step, high)))];
  }
  return [least, most];
}

/**
 * The multiples of the step that lie in an interval.
 * @param {number} low
 * @param {number} high
 * @param {number} n
 * @returns {number[]}
 */
function ticks(low, high, n) {
  const step = stepOf(high - low, n);
  let first = Math.round(quotient(step, low));
  let last = Math.round(quotient(step, high));
  if (multiple(step, first) < low) ++first;
  if (multiple(step, last) > high) --last;
  if (last < first && n >= 0.5 && n < 2) return ticks(low, high, 2 * n);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => multiple(step, first + i));
}

/**
 * About n multiples of a round step, from `least` and `most` widened to round numbers.
 * @param {number} least
 * @param {number} most
 * @param {number} n
 * @returns {number[]}
 */
export function niceTicks(least, most, n) {
  if (!(n > 0) || !(most >= least)) return [];
  if (least === most) return [least];
  const [low, high] = widened(least, most);
  return ticks(low, high, n);
}
