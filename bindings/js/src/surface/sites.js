// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites with longitudes and latitudes, triangulated once, and what is drawn of them.

import { named, number, numbers, numbersFor } from "../arguments.js";
import { unitVectors, voronoi } from "../build.js";
import { bordersOfCells, bordersOfTriangles, isolines } from "./lines.js";
import { meshOfCells, meshOfTriangles } from "./meshes.js";
import { drawnOptions } from "./options.js";

/** @typedef {import("./lines.js").Lines} Lines */
/** @typedef {import("./meshes.js").Mesh} Mesh */
/** @typedef {import("../arguments.js").Numbers} Numbers */
/** @typedef {import("./options.js").DrawnOptions} DrawnOptions */
/** @typedef {import("./options.js").Show} Show */

/** @typedef {{lon: Numbers, lat: Numbers}} Places longitudes and latitudes of sites, degrees */

/**
 * Returns longitudes and latitudes one after the other.
 * @param {Places} places what else it has is not looked at, except for options, which are no places
 */
export function pairs(places) {
  const misplaced = ["show", "spacing", "levels"].find((name) => name in named(places, undefined, "places"));
  if (misplaced) throw new TypeError(`places: ${misplaced} belongs in the options`);
  const lon = numbers(places.lon, 1, "lon");
  const lat = numbersFor(places.lat, lon.length, "lat", "longitudes");
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
   * @throws {import("../errors.js").RondelError} with the index of the first site that is not a place
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
   * @throws {import("../errors.js").RondelError} if a spacing makes too many points, or values are not one for each site
   */
  drawn(options = {}) {
    const { show, spacing, values, levels } = drawnOptions(options);
    const isKnown = show === "isolines" || values !== undefined;
    const known = isKnown ? numbersFor(/** @type {Numbers} */ (values), this.numSites, "values", "sites") : undefined;
    if (show === "cells") return meshOfCells(this.#diagram, spacing);
    if (show === "triangles") return meshOfTriangles(this.#diagram, spacing);
    if (show === "cell-borders") return bordersOfCells(this.#diagram, spacing);
    if (show === "triangle-borders") return bordersOfTriangles(this.#diagram, spacing);
    return isolines(this.#diagram, /** @type {any} */ (known), /** @type {any} */ (levels), spacing);
  }

  /**
   * Returns the site nearest to a place: the one whose cell it is in. noIndex without sites.
   * @param {number} lon degrees
   * @param {number} lat degrees
   */
  nearest(lon, lat) {
    return this.#diagram.nearest(unitVectors([number(lon, "lon"), number(lat, "lat")]))[0];
  }

  /** Frees the memory. */
  free() {
    this.#diagram.free();
  }
}
