// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks the arguments of users, and converts them to the arrays and structs that the module takes. An argument of the
// wrong kind is a TypeError, a value that breaks its contract a RondelError; the message begins with the argument's name.
// Numbers that are not finite are left to the module, which looks for them anyway.

import { RondelError } from "./errors.js";

/** @typedef {Int8Array | Uint8Array | Uint8ClampedArray | Int16Array | Uint16Array | Int32Array | Uint32Array} Integers */
/** @typedef {Float64Array | Float32Array | Integers | readonly number[]} Numbers numbers, one after the other */
/** @typedef {Integers | readonly number[]} Indices */

/**
 * The model and the sphere.
 * @typedef {object} Options
 * @property {"projected" | "weighted"} [model] a site is its exact projection on the sphere (the default): Delaunay
 *   triangulation, Voronoi diagram; or the circle whose pole it is: regular triangulation, power diagram
 * @property {readonly [number, number, number]} [center] the center of the sphere; default the origin
 * @property {number} [squaredRadius] the squared radius of the sphere; default 1
 */

/** The names of Options. */
const sphereOptions = ["model", "center", "squaredRadius"];

/** @param {any} value */
const isNumberArray = (value) => Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));

/** Returns a short text of a value of any kind. @param {any} value @returns {string} */
export function shown(value) {
  if (typeof value === "string") return JSON.stringify(value.length > 40 ? `${value.slice(0, 40)}...` : value);
  if (typeof value === "bigint") return "a BigInt";
  if (typeof value === "symbol" || typeof value === "function") return `a ${typeof value}`;
  if (typeof value !== "object" || value === null) return String(value);
  if (!isNumberArray(value)) return "an object";
  if (value.length > 4) return `an array of ${value.length} elements`;
  return `[${Array.from(value, (part) => (isNumberArray(part) ? "[...]" : shown(part))).join(", ")}]`;
}

/**
 * @param {any} values an array
 * @param {number} width numbers of an element
 * @param {string} what
 */
function copied(values, width, what) {
  if (ArrayBuffer.isView(values) && typeof /** @type {any} */ (values)[0] === "number") {
    return new Float64Array(/** @type {any} */ (values));
  }
  const result = new Float64Array(values.length);
  for (let i = 0; i < result.length; ++i) {
    const value = values[i];
    if (typeof value !== "number") throw noNumber(value, i, width, what);
    result[i] = value;
  }
  return result;
}

/** @param {any} value @param {number} i @param {number} width @param {string} what @returns {Error} */
function noNumber(value, i, width, what) {
  if (!isNumberArray(value)) {
    return new RondelError(`${what}: element ${i} is ${shown(value)}, not a number`, Math.floor(i / width));
  }
  return new TypeError(`${what}: the array is flat, [a, b, c, d, ...]; points.flat() makes it of an array of points`);
}

/** Whether the memory of an array now belongs to another thread. @param {any} values */
function isMoved(values) {
  try {
    if (ArrayBuffer.isView(values)) new Uint8Array(values.buffer);
    return false;
  } catch {
    return true;
  }
}

/**
 * @param {Numbers} values
 * @param {number} width numbers of an element
 * @param {string} what they are
 * @returns {Float64Array}
 */
export function numbers(values, width, what) {
  if (!isNumberArray(values)) {
    throw new TypeError(`${what}: an array of numbers is wanted, one after the other, not ${shown(values)}`);
  }
  if (values.length === 0 && isMoved(values)) {
    throw new TypeError(`${what}: the numbers of this array were moved to another thread`);
  }
  const result = values instanceof Float64Array ? values : copied(values, width, what);
  if (result.length % width === 0) return result;
  throw new RondelError(
    `${what}: the length ${result.length} is no multiple of ${width}`,
    Math.floor(result.length / width),
  );
}

/**
 * Numbers, one for each of n things.
 * @param {Numbers} values
 * @param {number} n
 * @param {string} what
 * @param {string} things
 */
export function numbersFor(values, n, what, things) {
  const result = numbers(values, 1, what);
  if (result.length === n) return result;
  throw new RondelError(`${what}: there are ${result.length} for ${n} ${things}`, Math.min(n, result.length));
}

/** One point. @param {Numbers} values @param {string} what */
export function threeNumbers(values, what) {
  const result = numbers(values, 3, what);
  if (result.length === 3) return result;
  throw new RondelError(`${what}: three numbers are wanted, not ${result.length}`, 0);
}

/** Few numbers, all finite. @param {Numbers} values @param {string} what */
export function finiteNumbers(values, what) {
  const result = numbers(values, 1, what);
  result.forEach((value, i) => {
    if (!Number.isFinite(value)) throw new RondelError(`${what}: element ${i} is ${value}, not a finite number`, i);
  });
  return result;
}

/** @param {unknown} value */
const isIndex = (value) => Number.isInteger(value) && Number(value) >= 0 && Number(value) < 2 ** 32;

/** @param {Indices} values @param {string} what @returns {Uint32Array} */
export function indices(values, what) {
  if (!isNumberArray(values)) throw new TypeError(`${what}: an array of indices is wanted, not ${shown(values)}`);
  if (values.length === 0 && isMoved(values)) throw new TypeError(`${what}: this array was moved to another thread`);
  if (values instanceof Uint32Array) return values;
  const result = new Uint32Array(values.length);
  for (let i = 0; i < result.length; ++i) {
    if (!isIndex(values[i])) throw new RondelError(`${what}: element ${i} is ${shown(values[i])}, not an index`, i);
    result[i] = values[i];
  }
  return result;
}

/** @param {number} value @param {string} what @returns {number} */
export function count(value, what) {
  if (isIndex(value)) return value;
  number(value, what);
  throw new RondelError(`${what} is ${value}, not a whole number from 0 to 2^32 - 1`, 0);
}

/**
 * Returns a number; where a least one is given, one that is finite and within the bounds.
 * @param {number} value
 * @param {string} what
 * @param {number} [least]
 * @param {number} [most]
 */
export function number(value, what, least, most = Infinity) {
  if (typeof value !== "number") throw new TypeError(`${what} is ${shown(value)}, not a number`);
  if (least === undefined || (Number.isFinite(value) && value >= least && value <= most)) return value;
  const range = most < Infinity ? ` from ${least} to ${most}` : least > -Infinity ? ` from ${least} on` : "";
  throw new RondelError(`${what} is ${value}, not a finite number${range}`, 0);
}

/** @template {string} T @param {T} value @param {readonly T[]} choices @param {string} what */
export function oneOf(value, choices, what) {
  if (choices.includes(value)) return value;
  throw new RondelError(`${what} is ${shown(value)}, not one of ${choices.map((choice) => `"${choice}"`).join(", ")}`, 0);
}

/** @template {Function} T @param {T} value @param {string} what */
export function callable(value, what) {
  if (typeof value === "function") return value;
  throw new TypeError(`${what} is ${shown(value)}, not a function`);
}

/**
 * Returns an object of options, not a Map or an array, if it has no other names than these.
 * @template {object} T
 * @param {T} value
 * @param {readonly string[]} [names] default: any
 * @param {string} [what]
 */
export function named(value, names, what = "options") {
  if (Object.prototype.toString.call(value) !== "[object Object]") {
    throw new TypeError(`${what}: an object is wanted, not ${shown(value)}`);
  }
  const unknown = names && Object.keys(value).find((name) => !names.includes(name));
  if (unknown === undefined) return value;
  throw new TypeError(`${what}: there is no ${shown(unknown)}; the names are ${names?.join(", ")}`);
}

/**
 * Writes a rondel_options: size, model, center, squared_radius.
 * @param {import("./engine.js").Engine} engine
 * @param {{room(n: number, size?: 4 | 8): number}} scope
 * @param {Options} options
 */
export function placeOptions(engine, scope, options) {
  const { model = "projected", center = [0, 0, 0], squaredRadius = 1 } = named(options, sphereOptions);
  const models = ["projected", "weighted"];
  const sphere = new Float64Array(4);
  sphere.set(threeNumbers(center, "center"));
  sphere[3] = number(squaredRadius, "squaredRadius");
  const place = scope.room(5, 8);
  new Uint32Array(engine.memory.buffer, place, 2).set([40, models.indexOf(oneOf(model, models, "model"))]);
  new Float64Array(engine.memory.buffer, place + 8, 4).set(sphere);
  return place;
}
