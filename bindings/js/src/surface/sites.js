// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites with longitudes and latitudes, triangulated once, and what is drawn of them.

import { voronoi } from "../build.js";
import { RondelError } from "../errors.js";
import { unitVectors } from "../build.js";
import { bordersOfCells, bordersOfTriangles, isolines } from "./lines.js";
import { meshOfCells, meshOfTriangles } from "./meshes.js";

/** @typedef {import("./lines.js").Lines} Lines */
/** @typedef {import("./meshes.js").Mesh} Mesh */
/** @typedef {"cells" | "triangles" | "isolines" | "cell-borders" | "triangle-borders"} Show */

/**
 * The arrays of a surface.
 * @typedef {object} DrawnOptions
 * @property {Show} [show] "cells" (the default), "triangles", "isolines", "cell-borders" or "triangle-borders"
 * @property {number} [spacing] degrees: sides that are longer are divided, so that flat pieces follow the globe (default
 *   2); 0: no points are added
 * @property {ArrayLike<number>} [values] isolines: one for each site; NaN: none
 * @property {ArrayLike<number>} [levels] isolines: the values of the lines
 */

/** @typedef {{lon: ArrayLike<number>, lat: ArrayLike<number>}} Places longitudes and latitudes of sites, degrees */

export const defaultSpacing = 2;

/**
 * Returns longitudes and latitudes one after the other.
 * @param {Places} places
 */
export function pairs({ lon, lat }) {
  if (lon?.length === undefined || lat?.length === undefined) {
    throw new TypeError("lon and lat are arrays of degrees");
  }
  if (lon.length !== lat.length) {
    throw new RondelError(`there are ${lon.length} longitudes and ${lat.length} latitudes`, Math.min(lon.length, lat.length));
  }
  const result = new Float64Array(2 * lon.length);
  for (let i = 0; i < lon.length; ++i) {
    result[2 * i] = lon[i];
    result[2 * i + 1] = lat[i];
  }
  return result;
}

/** Sites, their triangulation and their cells. */
export class DrawnSites {
  #diagram;

  /**
   * @param {Places} places
   * @throws {RondelError} with the index of the first site that is not a place
   */
  constructor(places) {
    this.#diagram = voronoi(unitVectors(pairs(places)));
  }

  /** The number of sites. */
  get numSites() {
    return this.#diagram.numSites;
  }

  /**
   * Makes what is drawn.
   * @param {DrawnOptions} [options]
   * @returns {Mesh | Lines}
   */
  drawn({ show = "cells", spacing = defaultSpacing, values, levels } = {}) {
    if (!(spacing >= 0)) throw new RondelError(`spacing = ${spacing} is not a number of degrees`, 0);
    if (show === "cells") return meshOfCells(this.#diagram, spacing);
    if (show === "triangles") return meshOfTriangles(this.#diagram, spacing);
    if (show === "cell-borders") return bordersOfCells(this.#diagram, spacing);
    if (show === "triangle-borders") return bordersOfTriangles(this.#diagram, spacing);
    if (show !== "isolines") throw new RondelError(`show is ${JSON.stringify(show)}, which is not known`, 0);
    if (!values || !levels) throw new TypeError("isolines need values and levels");
    return isolines(this.#diagram, values, levels, spacing);
  }

  /**
   * Returns the site nearest to a place: the one whose cell it is in. noIndex without sites.
   * @param {number} lon degrees
   * @param {number} lat degrees
   */
  nearest(lon, lat) {
    return this.#diagram.nearest(unitVectors([lon, lat]))[0];
  }

  /** Frees the memory. */
  free() {
    this.#diagram.free();
  }
}
