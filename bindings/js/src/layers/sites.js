// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites that layers draw: a worker triangulates them once, and makes what layers show.

import { RondelError } from "../errors.js";
import { startWorker } from "../worker/index.js";
import { extent } from "./colors.js";

/** @typedef {import("../surface/sites.js").DrawnOptions} DrawnOptions */
/** @typedef {import("../surface/lines.js").Lines} Lines */
/** @typedef {import("../surface/meshes.js").Mesh} Mesh */

/**
 * `lon` and `lat` are degrees, `values` has one for each site, NaN where there is none; default: NaN.
 * @typedef {{lon: ArrayLike<number>, lat: ArrayLike<number>, values?: ArrayLike<number>}} SitesOptions
 */

/** The site nearest to a place. @typedef {{site: number, value: number, lon: number, lat: number}} Picked */

const noIndex = 0xffffffff;

/** @param {ArrayLike<number> | undefined} values @param {number} n */
function checkedValues(values, n) {
  if (values === undefined) return new Float64Array(n).fill(NaN);
  if (values.length !== n) throw new RondelError(`there are ${values.length} values for ${n} sites`, Math.min(n, values.length));
  return Float64Array.from(values);
}

/** Sites with values, for any number of layers. */
export class SphereSites {
  /** @type {Map<string, Promise<Mesh | Lines>>} */
  #made = new Map();
  /** @type {Set<() => void>} */
  #listeners = new Set();
  #worker;
  #remote;

  /**
   * Triangulates sites in a worker of their own.
   * @param {SitesOptions} options
   * @returns {Promise<SphereSites>}
   * @throws {RondelError} with the index of the first site that is not a place
   */
  static async open({ lon, lat, values }) {
    const known = checkedValues(values, lon.length);
    const worker = await startWorker();
    try {
      const places = { lon: Float64Array.from(lon), lat: Float64Array.from(lat) };
      return new SphereSites(worker, await worker.sites(places), places, known);
    } catch (error) {
      await worker.stop();
      throw error;
    }
  }

  /**
   * Use open().
   * @param {import("../worker/index.js").RondelWorker} worker
   * @param {import("../worker/index.js").RemoteSites} remote
   * @param {{lon: Float64Array, lat: Float64Array}} places
   * @param {Float64Array} values
   */
  constructor(worker, remote, places, values) {
    this.#worker = worker;
    this.#remote = remote;
    /** The longitudes of the sites, degrees. */
    this.lon = places.lon;
    /** The latitudes of the sites, degrees. */
    this.lat = places.lat;
    /** The values of the sites, see setValues(). */
    this.values = values;
    this.valuesChanged = 0;
  }

  get numSites() {
    return this.lon.length;
  }

  /** The least and the largest value. @returns {[number, number]} */
  get extent() {
    return extent(this.values);
  }

  /** Changes the values; layers draw them. @param {ArrayLike<number>} values one for each site; NaN: none */
  setValues(values) {
    this.values = checkedValues(values, this.numSites);
    ++this.valuesChanged;
    for (const key of this.#made.keys()) if (key.startsWith("isolines")) this.#made.delete(key);
    for (const listener of this.#listeners) listener();
  }

  /** Calls a function whenever values have changed, until the function that it returns is called. @param {() => void} listener */
  onChange(listener) {
    this.#listeners.add(listener);
    return () => void this.#listeners.delete(listener);
  }

  /**
   * Returns the arrays that a layer draws; layers that show the same share them.
   * @param {DrawnOptions} options
   * @returns {Promise<Mesh | Lines>}
   */
  drawn({ show = "cells", spacing, levels }) {
    const key = [show, spacing, ...Array.from(levels ?? [])].join();
    const values = show === "isolines" ? this.values : undefined;
    let made = this.#made.get(key);
    if (!made) {
      made = this.#remote.drawn({ show, spacing, values, levels: levels && Float64Array.from(levels) });
      this.#made.set(key, made);
    }
    return made;
  }

  /**
   * Finds the site nearest to a place, which is the one whose cell it is in, exactly.
   * @param {number} lon degrees
   * @param {number} lat degrees
   * @returns {Promise<Picked | undefined>} undefined without sites
   */
  async at(lon, lat) {
    const site = await this.#remote.nearest(lon, lat);
    if (site === noIndex) return undefined;
    return { site, value: this.values[site], lon: this.lon[site], lat: this.lat[site] };
  }

  /** Ends the worker. Layers keep what they have drawn. */
  async close() {
    await this.#worker.stop();
  }
}
