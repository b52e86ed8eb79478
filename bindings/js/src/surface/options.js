// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The options of what is drawn, without what computes it, so that pages whose worker computes do not load that.

import { finiteNumbers, named, number, oneOf } from "../arguments.js";

/** @typedef {import("../arguments.js").Numbers} Numbers */
/** @typedef {"cells" | "triangles" | "isolines" | "cell-borders" | "triangle-borders"} Show */

/**
 * The arrays of a surface.
 * @typedef {object} DrawnOptions
 * @property {Show} [show] "cells" (the default), "triangles", "isolines", "cell-borders" or "triangle-borders"
 * @property {number} [spacing] degrees: sides that are longer are divided, so that flat pieces follow the globe (default
 *   2); 0: no points are added
 * @property {Numbers} [values] isolines: one for each site; NaN: none
 * @property {Numbers} [levels] isolines: the values of the lines
 */

/** @type {readonly Show[]} */
const shows = ["cells", "triangles", "isolines", "cell-borders", "triangle-borders"];

/**
 * Returns the options with their defaults, `values` as they are.
 * @param {DrawnOptions} options
 */
export function drawnOptions(options) {
  const { show = "cells", spacing = 2, values, levels } = named(options, ["show", "spacing", "values", "levels"]);
  oneOf(show, shows, "show");
  number(spacing, "spacing", 0);
  const isWanted = show === "isolines" || levels !== undefined;
  return { show, spacing, values, levels: isWanted ? finiteNumbers(/** @type {Numbers} */ (levels), "levels") : undefined };
}
