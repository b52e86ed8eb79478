// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A triangulation whose sites can be inserted, removed and moved.

import { count, indices, numbers, placeOptions } from "./arguments.js";
import { engine } from "./engine.js";
import { dispose, Handle } from "./instance.js";
import { RondelError } from "./errors.js";
import { Located } from "./located.js";
import { VoronoiDiagram } from "./triangulation.js";

/** @typedef {import("./arguments.js").Numbers} Numbers */
/** @typedef {import("./arguments.js").Indices} Indices */
/** @typedef {import("./arguments.js").Options} Options */

/**
 * At any time the triangulation is the one that delaunay() computes for the current sites. Each site has an id, which
 * it keeps until it is removed; then the id may be given to a new site. A call that throws changes nothing. The queries
 * of Located answer with ids; the faces of locate() are not valid after the next change.
 */
export class DynamicTriangulation extends Located {
  #handle;

  /**
   * @param {Numbers} [xyz] sites, of shape (n, 3), whose ids are 0 ... n-1
   * @param {Options} [options]
   */
  constructor(xyz = new Float64Array(), options = {}) {
    const owner = engine();
    super(owner);
    const sites = numbers(xyz, 3, "sites");
    const place = owner.scoped((scope) =>
      scope.made("rondel_dynamic_create", scope.copy(sites), sites.length / 3, placeOptions(owner, scope, options), 0),
    );
    this.#handle = new Handle(owner, "rondel_dynamic_free", place);
  }

  /** @protected @override */
  makeLocator() {
    const place = this.engine.scoped((scope) => scope.made("rondel_locator_create_dynamic", this.#handle.place));
    return new Handle(this.engine, "rondel_locator_free", place);
  }

  /** @type {number} */
  get numSites() {
    return this.engine.functions.rondel_dynamic_num_sites(this.#handle.place);
  }

  /** The ids in use, increasing. */
  get ids() {
    return this.engine.scoped((scope) => {
      const n = this.numSites;
      const place = scope.room(n);
      this.engine.call("rondel_dynamic_ids", this.#handle.place, place);
      return this.engine.indices(place, n);
    });
  }

  /**
   * Adds sites.
   * @param {Numbers} xyz of shape (n, 3)
   * @returns {Uint32Array} their ids, of shape (n,)
   * @throws {RondelError} with the first point that is not finite or, projected, the center
   */
  insert(xyz) {
    const sites = numbers(xyz, 3, "sites");
    this.freeLocator();
    return this.engine.scoped((scope) => {
      const n = sites.length / 3;
      const ids = scope.room(n);
      this.engine.call("rondel_insert", this.#handle.place, scope.copy(sites), n, 0, ids);
      return this.engine.indices(ids, n);
    });
  }

  /**
   * Removes sites.
   * @param {Indices} ids
   * @throws {RondelError} with the first position of an id that does not exist or appears twice
   */
  remove(ids) {
    const wanted = indices(ids, "ids");
    this.freeLocator();
    this.engine.scoped((scope) =>
      this.engine.call("rondel_remove", this.#handle.place, scope.copy(wanted), wanted.length, 0),
    );
  }

  /**
   * Moves site ids[i] to point i, one after the other.
   * @param {Indices} ids
   * @param {Numbers} xyz of shape (n, 3)
   * @throws {RondelError} like remove() and insert(), and if the lengths differ; an id may appear again
   */
  move(ids, xyz) {
    const wanted = indices(ids, "ids");
    const points = numbers(xyz, 3, "points");
    if (points.length !== 3 * wanted.length) {
      throw new RondelError(`there are ${points.length / 3} points for ${wanted.length} sites to move`, 0);
    }
    this.freeLocator();
    this.engine.scoped((scope) =>
      this.engine.call("rondel_move", this.#handle.place, scope.copy(wanted), scope.copy(points), wanted.length, 0),
    );
  }

  /**
   * Moves all sites at once, site ids[i] to point i. Where sites move by little, this takes less time than a
   * triangulation of the points.
   * @param {Numbers} xyz of shape (numSites, 3)
   * @throws {RondelError} like insert(), and if there is not one point for each site
   */
  moveAll(xyz) {
    const points = numbers(xyz, 3, "points");
    this.freeLocator();
    this.engine.scoped((scope) =>
      this.engine.call("rondel_move_all", this.#handle.place, scope.copy(points), points.length / 3, 0),
    );
  }

  /**
   * The vertices adjacent to a vertex, counterclockwise from the lowest.
   * @param {number} id
   * @returns {Uint32Array} ids
   */
  neighbors(id) {
    const site = count(id, "id");
    return this.engine.scoped((scope) => {
      const { functions } = this.engine;
      const lists = scope.made("rondel_dynamic_neighbors", this.#handle.place, site);
      const [, n] = this.engine.offsets(functions.rondel_list_offsets(lists), 2);
      const result = this.engine.indices(functions.rondel_list_items(lists), n);
      functions.rondel_lists_free(lists);
      return result;
    });
  }

  /** Returns the current diagram; its site i is the i-th of `ids`. @returns {VoronoiDiagram} */
  snapshot() {
    const place = this.engine.scoped((scope) => scope.made("rondel_dynamic_snapshot", this.#handle.place));
    return new VoronoiDiagram(this.engine, place);
  }

  /** Frees its memory. */
  free() {
    this.freeLocator();
    this.#handle.free();
  }

  [dispose]() {
    this.free();
  }
}
