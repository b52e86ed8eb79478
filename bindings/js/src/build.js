// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes triangulations, and sites from longitudes and latitudes.

import { named, numbers, numbersFor, placeOptions, shown } from "./arguments.js";
import { engine } from "./engine.js";
import { RondelError } from "./errors.js";
import { unitVectorsBy } from "./instance.js";
import { Triangulation, VoronoiDiagram } from "./triangulation.js";

/** @typedef {import("./arguments.js").Numbers} Numbers */
/** @typedef {import("./arguments.js").Options} Options */
/** @typedef {import("./engine.js").Engine} Engine */

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
 * Converts longitudes and latitudes to unit vectors, with the same bits on every machine; multiples of 90 degrees are
 * exact.
 * @param {Numbers} lonLat degrees, of shape (n, 2)
 * @returns {Float64Array} of shape (n, 3)
 * @throws {RondelError} for the first angle that is not finite, or latitude outside [-90, 90]
 */
export function unitVectors(lonLat) {
  return unitVectorsBy(engine(), numbers(lonLat, 2, "longitudes and latitudes"));
}

/**
 * Converts circles on the unit sphere to weighted sites, the poles of their planes.
 * @param {Numbers} lonLat centers, degrees, of shape (n, 2)
 * @param {Numbers} radii angular, degrees in [0, 90), of shape (n,)
 * @returns {Float64Array} of shape (n, 3)
 * @throws {RondelError} for the first circle that is none, and if there is not one radius for each center
 */
export function polarPoints(lonLat, radii) {
  const owner = engine();
  const angles = numbers(lonLat, 2, "longitudes and latitudes");
  const n = angles.length / 2;
  const sizes = numbersFor(radii, n, "radii", "centers");
  return owner.scoped((scope) => {
    const place = scope.room(3 * n, 8);
    owner.call("rondel_polar_points", scope.copy(angles), scope.copy(sizes), n, place);
    return owner.doubles(place, 3 * n);
  });
}

/**
 * The sphere is the unit sphere around the origin. With `radii`, degrees in [0, 90), the sites are circles, in the
 * weighted model.
 * @typedef {Pick<Options, "model"> & {radii?: Numbers}} LonLatOptions
 */

const lonLatOptions = ["model", "radii"];

/**
 * Returns the function that makes a Type of sites, with its lonLat().
 * @template {Triangulation} T
 * @param {new (owner: Engine, place: number) => T} Type
 */
export function maker(Type) {
  /** @param {Numbers} xyz @param {Options} [options] @returns {T} */
  const make = (xyz, options = {}) => build(Type, engine(), numbers(xyz, 3, "sites"), options);
  /** @param {Numbers} lonLat @param {LonLatOptions} [options] @returns {T} */
  const lonLat = (lonLat, options = {}) => {
    const { radii, ...others } = named(options, lonLatOptions);
    if (radii === undefined) return make(unitVectors(lonLat), others);
    const { model = "weighted" } = others;
    if (model !== "weighted") throw new RondelError(`model is ${shown(model)}, but circles are "weighted"`, 0);
    return make(polarPoints(lonLat, radii), { ...others, model });
  };
  return Object.assign(make, { lonLat });
}

/**
 * Computes the triangulation of sites x0, y0, z0, x1, ...: unique and exact for every finite input.
 * `delaunay.lonLat(array, options)` takes longitudes and latitudes in degrees.
 * @throws {RondelError} if a coordinate is not finite or a projected site is the center
 * @throws {TypeError} if sites are no array of numbers, or an option does not exist
 * @throws {RangeError} if memory runs out
 */
export const delaunay = maker(Triangulation);

/** Does the same as delaunay(), and adds `cells`, `areas` and `centers` of the Voronoi or power diagram. */
export const voronoi = maker(VoronoiDiagram);
