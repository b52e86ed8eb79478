// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulations and their duals.

import { dispose, Engine, Handle } from "./instance.js";
import { Located } from "./located.js";

/**
 * The cells of a diagram in compressed rows: the ring of site i is rings[offsets[i]] ... rings[offsets[i + 1] - 1],
 * positions in points (x, y, z of unit vectors), counterclockwise seen from outside. The first numFaces points are the
 * circumcenters of the faces. Duplicates and hidden sites have empty rings; so has a single vertex, whose cell is the
 * whole sphere.
 * @typedef {{offsets: Uint32Array, rings: Uint32Array, points: Float64Array}} Cells
 */

/**
 * A Delaunay or regular triangulation. Its arrays are copies, made when they are first read; they remain valid after it
 * is freed. Its memory is freed by free(), at the end of a `using` block, or some time after nothing refers to it.
 */
export class Triangulation extends Located {
  /** @type {Map<string, any>} */
  #arrays = new Map();
  /** @protected @type {Handle} */
  handle;

  /**
   * Use delaunay() or voronoi().
   * @param {Engine} owner
   * @param {number} place of a rondel_triangulation, which it owns from now on
   */
  constructor(owner, place) {
    if (!(owner instanceof Engine)) throw new TypeError("delaunay() makes triangulations, not this constructor");
    super(owner);
    this.handle = new Handle(owner, "rondel_triangulation_free", place);
  }

  /** @protected @override */
  makeLocator() {
    const place = this.engine.scoped((scope) => scope.made("rondel_locator_create", this.handle.place));
    return new Handle(this.engine, "rondel_locator_free", place);
  }

  /** @param {string} name of a function without other arguments @returns {number} */
  #number(name) {
    return this.once(name, () => this.engine.functions[name](this.handle.place));
  }

  /**
   * @template T
   * @protected
   * @param {string} key
   * @param {() => T} make
   * @returns {T}
   */
  once(key, make) {
    if (!this.#arrays.has(key)) this.#arrays.set(key, make());
    return this.#arrays.get(key);
  }

  /** @param {string} name @param {string} number of elements: a function @param {number} width @returns {Uint32Array} */
  #indices(name, number, width) {
    const n = width * this.#number(number);
    return this.once(`all of ${name}`, () => this.engine.indices(this.#number(name), n));
  }

  /** @param {string} name @param {number} n @returns {Float64Array} what a function writes to an array of n numbers */
  #written(name, n) {
    return this.once(name, () =>
      this.engine.scoped((scope) => {
        const place = scope.room(n, 8);
        this.engine.call(name, this.handle.place, 0, place);
        return this.engine.doubles(place, n);
      }),
    );
  }

  /** -1 without sites; 0: one vertex; 1: all on one great circle, in `ring`; 2: a closed surface of faces. */
  get dimension() {
    return this.#number("rondel_dimension");
  }
  /** @returns {"projected" | "weighted"} */
  get model() {
    return this.#number("rondel_model") === 0 ? "projected" : "weighted";
  }
  get numSites() {
    return this.#number("rondel_num_sites");
  }
  get numVertices() {
    return this.#number("rondel_num_vertices");
  }
  get numFaces() {
    return this.#number("rondel_num_faces");
  }

  /** The sites, of shape (numSites, 3). */
  get points() {
    return this.once("points", () => this.engine.doubles(this.#number("rondel_points"), 3 * this.numSites));
  }
  /** The corners of the faces, counterclockwise seen from outside, in the library's order; of shape (numFaces, 3). */
  get triangles() {
    return this.#indices("rondel_faces", "rondel_num_faces", 3);
  }
  /** The face across the edge opposite to each corner, of shape (numFaces, 3). */
  get neighbors() {
    return this.#indices("rondel_neighbors", "rondel_num_faces", 3);
  }
  /** The faces that the center of the sphere is not strictly below, increasing. */
  get ghostFaces() {
    return this.#indices("rondel_ghost_faces", "rondel_num_ghost_faces", 1);
  }
  /** Below dimension 2: the vertices in their order around the great circle. */
  get ring() {
    return this.#indices("rondel_ring", "rondel_num_ring", 1);
  }
  /** Pairs of a site and the lowest site in the same place, increasing; of shape (m, 2). */
  get duplicates() {
    return this.#indices("rondel_duplicates", "rondel_num_duplicates", 2);
  }
  /** Pairs of a site that is no vertex and a face below which it lies, increasing; of shape (m, 2). */
  get hidden() {
    return this.#indices("rondel_hidden", "rondel_num_hidden", 2);
  }
  /** The edges, lower index first, in lexicographic order; of shape (m, 2). */
  get edges() {
    return this.once("edges", () =>
      this.engine.scoped((scope) => {
        const number = scope.room(1);
        this.engine.call("rondel_edges", this.handle.place, 0, 0, number);
        const [n] = this.engine.indices(number, 1);
        const place = scope.room(2 * n);
        this.engine.call("rondel_edges", this.handle.place, place, n, number);
        return this.engine.indices(place, 2 * n);
      }),
    );
  }
  /** The circumcenters (power centers) of the faces: unit vectors, of shape (numFaces, 3). */
  get centers() {
    return this.#written("rondel_circumcenters", 3 * this.numFaces);
  }
  /** The directions of the cells' centers of mass: unit vectors, 0 for empty cells; of shape (numSites, 3). */
  get centroids() {
    return this.#written("rondel_centroids", 3 * this.numSites);
  }

  /** Frees its memory. Arrays that were read before remain valid. */
  free() {
    this.freeLocator();
    this.handle.free();
  }

  [dispose]() {
    this.free();
  }
}

/** A triangulation and its dual: the Voronoi or power diagram. */
export class VoronoiDiagram extends Triangulation {
  get #diagram() {
    return this.once("diagram", () => {
      const { engine: owner } = this;
      const { functions } = owner;
      const place = owner.scoped((scope) => scope.made("rondel_diagram_create", this.handle.place, 0));
      try {
        const offsets = owner.offsets(functions.rondel_cell_offsets(place), this.numSites + 1);
        const rings = owner.indices(functions.rondel_cell_rings(place), offsets[offsets.length - 1]);
        const points = owner.doubles(functions.rondel_cell_points(place), 3 * functions.rondel_num_cell_points(place));
        return {
          cells: /** @type {Cells} */ ({ offsets, rings, points }),
          areas: owner.doubles(functions.rondel_cell_areas(place), this.numSites),
        };
      } finally {
        functions.rondel_diagram_free(place);
      }
    });
  }

  /** The cells of all sites. */
  get cells() {
    return this.#diagram.cells;
  }
  /** The areas of the cells in steradians, 0 for duplicates and hidden sites; of shape (numSites,). */
  get areas() {
    return this.#diagram.areas;
  }
}
