// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulations, their duals, and what is asked of them.

import { count, numbers, placeOptions } from "./arguments.js";
import { engine, Handle } from "./engine.js";

/** @typedef {import("./arguments.js").Numbers} Numbers */
/** @typedef {import("./arguments.js").Options} Options */
/** @typedef {import("./engine.js").Engine} Engine */

/** Stands for "none" in arrays of indices. */
export const noIndex = 0xffffffff;

/** The method that `using` calls, also where the language does not know it yet. */
export const dispose = /** @type {any} */ (/** @type {any} */ (Symbol).dispose ?? Symbol.for("Symbol.dispose"));

/**
 * Lists of sites in compressed rows: list i is sites[offsets[i]] ... sites[offsets[i + 1] - 1].
 * @typedef {{offsets: Uint32Array, sites: Uint32Array}} SiteLists
 */

/**
 * The cells of a diagram in compressed rows: the ring of site i is rings[offsets[i]] ... rings[offsets[i + 1] - 1],
 * positions in points (x, y, z of unit vectors), counterclockwise seen from outside. The first numFaces points are the
 * circumcenters of the faces. Duplicates and hidden sites have empty rings; so has a single vertex, whose cell is the
 * whole sphere.
 * @typedef {{offsets: Uint32Array, rings: Uint32Array, points: Float64Array}} Cells
 */

/**
 * What the rays from the center through n points meet: `where` has 0 for a vertex, 1 for an edge, 2 for a face, 3 for
 * none (outside); `faces` a face that has it, of shape (n,); `sites` its one, two or three sites, of shape (n, 3),
 * filled up with noIndex.
 * @typedef {{where: Int32Array, faces: Uint32Array, sites: Uint32Array}} Locations
 */

/** Questions about places, which triangulations and dynamic ones answer. All answers are exact, ties included. */
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
   * The nearest site to each point; of several the lowest index, without sites noIndex.
   * @param {Numbers} points of shape (n, 3), which stand for their directions from the center
   * @returns {Uint32Array} of shape (n,)
   * @throws {import("./errors.js").RondelError} with the first point that is not finite or the center, as all questions do
   */
  nearest(points) {
    return this.#ask(points, (place, n, locator, scope) => {
      const sites = scope.room(n);
      this.engine.call("rondel_nearest", locator, place, n, 0, sites);
      return this.engine.indices(sites, n);
    });
  }

  /**
   * The k nearest sites to each point in order of distance, filled up with noIndex.
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
   * The sites at a distance of at most `angle` from each point, in increasing order.
   * @param {Numbers} points of shape (n, 3)
   * @param {number} angle radians
   * @returns {SiteLists}
   */
  within(points, angle) {
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
   * The vertex, edge or face that each point lies on.
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
   * The distance between a point and a site in radians; weighted, the Laguerre distance.
   * @param {Numbers} point x, y, z
   * @param {number} site
   * @returns {number}
   */
  distance(point, site) {
    count(site, "site");
    return this.#ask(point, (place, n, locator, scope) => {
      if (n !== 1) throw new TypeError("distance: one point is wanted");
      const result = scope.room(1, 8);
      this.engine.call("rondel_distance", locator, place, site, result);
      return this.engine.doubles(result, 1)[0];
    });
  }
}

/**
 * A Delaunay or regular triangulation. Arrays are copies, made when first asked for; they stay when it is freed.
 * Its memory is given back by free(), at the end of a `using` block, or some time after nothing refers to it.
 */
export class Triangulation extends Located {
  /** @type {Map<string, any>} */
  #arrays = new Map();
  /** @protected @type {Handle} */
  handle;

  /** @param {Engine} owner @param {number} place of a rondel_triangulation, which it owns from now on */
  constructor(owner, place) {
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

  /** Gives its memory back. Arrays that were asked for stay. */
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

/**
 * @template {Triangulation} T
 * @param {new (owner: Engine, place: number) => T} Type
 * @param {Engine} owner
 * @param {Float64Array} sites
 * @param {Options} options
 */
export function build(Type, owner, sites, options) {
  const place = owner.scoped((scope) =>
    scope.made("rondel_delaunay", scope.copy(sites), sites.length / 3, placeOptions(owner, scope, options), 0),
  );
  return new Type(owner, place);
}

/**
 * The unit vectors of longitudes and latitudes, the same bits on every machine; multiples of 90 degrees are exact.
 * @param {Numbers} lonLat degrees, of shape (n, 2)
 * @returns {Float64Array} of shape (n, 3)
 * @throws {import("./errors.js").RondelError} for the first angle that is not finite, or latitude outside [-90, 90]
 */
export function unitVectors(lonLat) {
  const owner = engine();
  const angles = numbers(lonLat, 2, "longitudes and latitudes");
  const n = angles.length / 2;
  return owner.scoped((scope) => {
    const place = scope.room(3 * n, 8);
    owner.call("rondel_unit_vectors", scope.copy(angles), n, place);
    return owner.doubles(place, 3 * n);
  });
}

/**
 * The weighted sites of circles on the unit sphere: the poles of their planes.
 * @param {Numbers} lonLat centers, degrees, of shape (n, 2)
 * @param {Numbers} radii angular, degrees in [0, 90), of shape (n,)
 * @returns {Float64Array} of shape (n, 3)
 */
export function polarPoints(lonLat, radii) {
  const owner = engine();
  const angles = numbers(lonLat, 2, "longitudes and latitudes");
  const n = angles.length / 2;
  const sizes = numbers(radii, 1, "radii");
  if (sizes.length !== n) throw new RangeError(`there are ${sizes.length} radii for ${n} centers`);
  return owner.scoped((scope) => {
    const place = scope.room(3 * n, 8);
    owner.call("rondel_polar_points", scope.copy(angles), scope.copy(sizes), n, place);
    return owner.doubles(place, 3 * n);
  });
}

/**
 * With `radii`, degrees in [0, 90), the sites are circles, in the weighted model.
 * @typedef {Options & {radii?: Numbers}} LonLatOptions
 */

/**
 * The function that makes a Type of sites, with its lonLat().
 * @template {Triangulation} T
 * @param {new (owner: Engine, place: number) => T} Type
 */
export function maker(Type) {
  /** @param {Numbers} xyz @param {Options} [options] @returns {T} */
  const make = (xyz, options = {}) => build(Type, engine(), numbers(xyz, 3, "sites"), options);
  /** @param {Numbers} lonLat @param {LonLatOptions} [options] @returns {T} */
  const lonLat = (lonLat, { radii, ...options } = {}) => {
    if (radii === undefined) return make(unitVectors(lonLat), options);
    return make(polarPoints(lonLat, radii), { ...options, model: "weighted" });
  };
  return Object.assign(make, { lonLat });
}

/**
 * The triangulation of sites x0, y0, z0, x1, ...: unique and exact for every finite input.
 * `delaunay.lonLat(array, options)` takes longitudes and latitudes in degrees.
 * @throws {import("./errors.js").RondelError} if a coordinate is not finite or a projected site is the center
 * @throws {RangeError} where memory runs out
 */
export const delaunay = maker(Triangulation);

/** As delaunay(), with `cells`, `areas` and `centers` of the Voronoi or power diagram. */
export const voronoi = maker(VoronoiDiagram);
