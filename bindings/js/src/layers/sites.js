// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites that layers draw: a worker triangulates them once, and makes what layers show.

import { callable, named, number, numbers, numbersFor } from "../arguments.js";
import { drawnOptions } from "../surface/options.js";
import { RondelWorker, startWorker } from "../worker/index.js";
import { extent } from "./colors.js";

/** @typedef {import("../arguments.js").Numbers} Numbers */
/** @typedef {import("../surface/options.js").DrawnOptions} DrawnOptions */
/** @typedef {import("../surface/lines.js").Lines} Lines */
/** @typedef {import("../surface/meshes.js").Mesh} Mesh */

/**
 * `lon` and `lat` are degrees, `values` has one for each site, NaN where there is none; default: NaN.
 * @typedef {{lon: Numbers, lat: Numbers, values?: Numbers}} SitesOptions
 */

/** The site nearest to a place. @typedef {{site: number, value: number, lon: number, lat: number}} Picked */

const noIndex = 0xffffffff;

const mostKept = 16; // what is drawn for more layers than these is made again

/** A copy of the values of n sites. @param {Numbers} values @param {number} n */
const valuesFor = (values, n) => numbersFor(values, n, "values", "sites").slice();

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
   * @throws {import("../errors.js").RondelError} with the index of the first site that is not a place
   */
  static async open(options) {
    const { values, ...given } = named(options, ["lon", "lat", "values"]);
    const lon = numbers(given.lon, 1, "lon").slice();
    const places = { lon, lat: numbersFor(given.lat, lon.length, "lat", "longitudes").slice() };
    const known = values === undefined ? new Float64Array(lon.length).fill(NaN) : valuesFor(values, lon.length);
    const worker = await startWorker();
    try {
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
    if (!(worker instanceof RondelWorker)) throw new TypeError("SphereSites.open() makes sites, not this constructor");
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

  /** Changes the values; layers draw them. @param {Numbers} values one for each site; NaN: none */
  setValues(values) {
    this.values = valuesFor(values, this.numSites);
    ++this.valuesChanged;
    for (const key of this.#made.keys()) if (key.startsWith("isolines")) this.#made.delete(key);
    for (const listener of this.#listeners) listener();
  }

  /** Calls a function whenever values have changed, until the function that it returns is called. @param {() => void} listener */
  onChange(listener) {
    this.#listeners.add(callable(listener, "listener"));
    return () => void this.#listeners.delete(listener);
  }

  /**
   * Returns the arrays that a layer draws; layers that show the same share them, as long as these are among the last 16
   * that were asked.
   * @param {Omit<DrawnOptions, "values">} [options] isolines are those of the sites' values
   * @returns {Promise<Mesh | Lines>}
   */
  drawn(options = {}) {
    const { show, spacing, levels } = drawnOptions(named(options, ["show", "spacing", "levels"]));
    const key = [show, spacing, ...(levels ?? [])].join();
    const values = show === "isolines" ? this.values : undefined;
    const made = this.#made.get(key) ?? this.#remote.drawn({ show, spacing, values, levels });
    this.#keep(key, made);
    return made;
  }

  /** Keeps what is made, as the last one that was asked, unless it fails. @param {string} key @param {Promise<Mesh | Lines>} made */
  #keep(key, made) {
    this.#made.delete(key);
    this.#made.set(key, made);
    made.catch(() => this.#made.get(key) === made && this.#made.delete(key));
    for (const oldest of this.#made.keys()) {
      if (this.#made.size <= mostKept) break;
      this.#made.delete(oldest);
    }
  }

  /**
   * Finds the site nearest to a place, which is the one whose cell it is in, exactly.
   * @param {number} lon degrees
   * @param {number} lat degrees
   * @returns {Promise<Picked | undefined>} undefined without sites
   */
  async at(lon, lat) {
    const site = await this.#remote.nearest(number(lon, "lon"), number(lat, "lat"));
    if (site === noIndex) return undefined;
    return { site, value: this.values[site], lon: this.lon[site], lat: this.lat[site] };
  }

  /** Ends the worker. Layers keep what they have drawn. */
  async close() {
    await this.#worker.stop();
  }
}
