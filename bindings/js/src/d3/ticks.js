// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Round numbers that divide an interval into about so many parts.

/** The step 1, 2 or 5 times a power of ten whose ratio to the exact one is nearest to 1. @param {number} exact */
function roundStep(exact) {
  const power = 10 ** Math.floor(Math.log10(exact));
  const ratio = exact / power;
  if (ratio >= Math.sqrt(50)) return 10 * power;
  if (ratio >= Math.sqrt(10)) return 5 * power;
  return ratio >= Math.sqrt(2) ? 2 * power : power;
}

/**
 * About n multiples of a round step from below `least` to above `most`.
 * @param {number} least
 * @param {number} most
 * @param {number} n
 * @returns {number[]}
 */
export function niceTicks(least, most, n) {
  if (!(most > least)) return least === most ? [least] : [];
  const step = roundStep((most - least) / n);
  const begin = Math.floor(least / step);
  const end = Math.ceil(most / step);
  // Of a step below 1 the multiples are quotients, which round correctly: 3 / 10, not 3 * 0.1.
  const inverse = Math.round(1 / step);
  return Array.from({ length: end - begin + 1 }, (_, i) => (step < 1 ? (begin + i) / inverse : (begin + i) * step));
}
