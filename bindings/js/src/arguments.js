// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Converts the arguments of users to the arrays and structs that the module takes.

import { RondelError } from "./errors.js";

/** @typedef {Float64Array | Float32Array | readonly number[]} Numbers coordinates, one after the other */
/** @typedef {Uint32Array | readonly number[]} Indices */

/**
 * The model and the sphere.
 * @typedef {object} Options
 * @property {"projected" | "weighted"} [model] a site is its exact projection on the sphere (the default): Delaunay
 *   triangulation, Voronoi diagram; or the circle whose pole it is: regular triangulation, power diagram
 * @property {readonly [number, number, number]} [center] the center of the sphere; default the origin
 * @property {number} [squaredRadius] the squared radius of the sphere; default 1
 */

const models = ["projected", "weighted"];

/**
 * @param {Numbers} values
 * @param {number} width numbers of an element
 * @param {string} what they are
 * @returns {Float64Array}
 */
export function numbers(values, width, what) {
  if (!(ArrayBuffer.isView(values) || Array.isArray(values)) || values instanceof DataView) {
    throw new TypeError(`${what}: an array of numbers is wanted, one after the other`);
  }
  if (Array.isArray(values) && values.some((value) => typeof value === "object")) {
    throw new TypeError(`${what}: the array is flat, [a, b, c, d, ...]; points.flat() makes it of an array of points`);
  }
  const result = values instanceof Float64Array ? values : Float64Array.from(values);
  if (result.length % width === 0) return result;
  throw new RondelError(
    `${what}: the length ${result.length} is no multiple of ${width}`,
    Math.floor(result.length / width),
  );
}

/** @param {Indices} values @returns {Uint32Array} */
export function indices(values) {
  if (values instanceof Uint32Array) return values;
  if (!Array.isArray(values)) throw new TypeError("an array of indices is wanted");
  const bad = values.findIndex((value) => !(Number.isInteger(value) && value >= 0 && value < 2 ** 32));
  if (bad >= 0) throw new RondelError(`${values[bad]} is no index`, bad);
  return Uint32Array.from(values);
}

/** @param {number} value @param {string} what @returns {number} */
export function count(value, what) {
  if (Number.isInteger(value) && value >= 0 && value < 2 ** 32) return value;
  throw new RondelError(`${what} = ${value} is no count`, 0);
}

/**
 * Writes a rondel_options: size, model, center, squared_radius.
 * @param {import("./engine.js").Engine} engine
 * @param {{room(n: number, size?: 4 | 8): number}} scope
 * @param {Options} options
 */
export function placeOptions(engine, scope, { model = "projected", center = [0, 0, 0], squaredRadius = 1 }) {
  const number = models.indexOf(model);
  if (number < 0) throw new RondelError(`the model ${model} is neither "projected" nor "weighted"`, 0);
  const sphere = numbers([...center, squaredRadius], 4, "center");
  const place = scope.room(5, 8);
  new Uint32Array(engine.memory.buffer, place, 2).set([40, number]);
  new Float64Array(engine.memory.buffer, place + 8, 4).set(sphere);
  return place;
}
