// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Queries of position and distance.

import { count, number, numbers, threeNumbers } from "./arguments.js";

/** @typedef {import("./arguments.js").Numbers} Numbers */
/** @typedef {import("./engine.js").Engine} Engine */
/** @typedef {import("./instance.js").Handle} Handle */

/** The index that means "none" in arrays of indices. */
export const noIndex = 0xffffffff;

/**
 * Lists of sites in compressed rows: list i is sites[offsets[i]] ... sites[offsets[i + 1] - 1].
 * @typedef {{offsets: Uint32Array, sites: Uint32Array}} SiteLists
 */

/**
 * The vertex, edge or face that the ray from the center through each of n points meets: `where` is 0 for a vertex, 1
 * for an edge, 2 for a face, 3 for none (outside); `faces`, shape (n,), a face that contains it; `sites`, shape (n, 3),
 * its one, two or three sites, filled up with noIndex.
 * @typedef {{where: Int32Array, faces: Uint32Array, sites: Uint32Array}} Locations
 */

/** Queries of static and dynamic triangulations. All answers are exact, ties included. */
export class Located {
  /** @type {Handle | undefined} */
  #locator;

  /** @param {Engine} owner */
  constructor(owner) {
    /** @protected @type {Engine} */
    this.engine = owner;
  }

  /** Makes a locator. @protected @returns {Handle} */
  makeLocator() {
    throw new Error("of a derived class");
  }

  /** @protected */
  freeLocator() {
    this.#locator?.free();
    this.#locator = undefined;
  }

  /**
   * @template T
   * @param {Numbers} points
   * @param {(place: number, n: number, locator: number, scope: any) => T} work
   * @returns {T}
   */
  #ask(points, work) {
    const xyz = numbers(points, 3, "points");
    this.#locator ??= this.makeLocator();
    const { place } = this.#locator;
    return this.engine.scoped((scope) => work(scope.copy(xyz), xyz.length / 3, place, scope));
  }

  /**
   * Finds the nearest site to each point; of several the lowest index, and noIndex if there are no sites.
   * @param {Numbers} points of shape (n, 3), which stand for their directions from the center
   * @returns {Uint32Array} of shape (n,)
   * @throws {import("./errors.js").RondelError} with the first point that is not finite or the center, like all queries
   */
  nearest(points) {
    return this.#ask(points, (place, n, locator, scope) => {
      const sites = scope.room(n);
      this.engine.call("rondel_nearest", locator, place, n, 0, sites);
      return this.engine.indices(sites, n);
    });
  }

  /**
   * Finds the k nearest sites to each point in order of distance, filled up with noIndex.
   * @param {Numbers} points of shape (n, 3)
   * @param {number} k
   * @returns {Uint32Array} of shape (n, k)
   */
  kNearest(points, k) {
    count(k, "k");
    return this.#ask(points, (place, n, locator, scope) => {
      if (n * k >= 2 ** 30) throw new RangeError("Rondel: out of memory");
      const sites = scope.room(n * k);
      this.engine.call("rondel_k_nearest", locator, place, n, k, 0, sites);
      return this.engine.indices(sites, n * k);
    });
  }

  /**
   * Finds the sites at a distance of at most `angle` from each point, in increasing order.
   * @param {Numbers} points of shape (n, 3)
   * @param {number} angle radians
   * @returns {SiteLists}
   */
  within(points, angle) {
    number(angle, "angle");
    return this.#ask(points, (place, n, locator, scope) => {
      const lists = scope.made("rondel_within", locator, place, n, angle, 0);
      try {
        const offsets = this.engine.offsets(this.engine.functions.rondel_list_offsets(lists), n + 1);
        return { offsets, sites: this.engine.indices(this.engine.functions.rondel_list_items(lists), offsets[n]) };
      } finally {
        this.engine.functions.rondel_lists_free(lists);
      }
    });
  }

  /**
   * Finds the vertex, edge or face that each point lies on.
   * @param {Numbers} points of shape (n, 3)
   * @returns {Locations}
   */
  locate(points) {
    return this.#ask(points, (place, n, locator, scope) => {
      const [where, faces, sites] = [scope.room(n), scope.room(n), scope.room(3 * n)];
      this.engine.call("rondel_locate", locator, place, n, 0, where, faces, sites);
      return {
        where: new Int32Array(this.engine.indices(where, n).buffer),
        faces: this.engine.indices(faces, n),
        sites: this.engine.indices(sites, 3 * n),
      };
    });
  }

  /**
   * Returns the distance between a point and a site in radians; for the weighted model the Laguerre distance.
   * @param {Numbers} point x, y, z
   * @param {number} site
   * @returns {number}
   */
  distance(point, site) {
    count(site, "site");
    return this.#ask(threeNumbers(point, "point"), (place, _, locator, scope) => {
      const result = scope.room(1, 8);
      this.engine.call("rondel_distance", locator, place, site, result);
      return this.engine.doubles(result, 1)[0];
    });
  }
}
