// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Divides triangles and arcs on the unit sphere until no side is longer than a spacing, so that flat pieces follow the
// globe. Whether a side is divided depends on the side alone, and its middle is made once, so that triangles that share
// a side share its pieces: there are no gaps.

import { RondelError } from "../errors.js";

const radiansPerDegree = Math.PI / 180;
const mostPoints = 2 ** 24 - 1; // so many entries a Map of V8 has

/** @param {number} spacing */
const tooFine = (spacing) => new RondelError(`spacing is ${spacing} degrees, which makes more than ${mostPoints} points`, 0);

/** An array of numbers that grows. */
class Growing {
  /** @param {Float64Array | Uint32Array} values the numbers to begin with */
  constructor(values) {
    this.values = values;
    this.length = values.length;
  }

  /** Appends numbers, and returns the position of the first one. @param {number[]} numbers */
  add(...numbers) {
    if (this.length + numbers.length > this.values.length) {
      const Type = /** @type {any} */ (this.values.constructor);
      const larger = new Type(2 * this.values.length + 64);
      larger.set(this.values);
      this.values = larger;
    }
    this.values.set(numbers, this.length);
    this.length += numbers.length;
    return this.length - numbers.length;
  }

  /** Appends three numbers, where there is room for them. @param {number} a @param {number} b @param {number} c */
  addHere(a, b, c) {
    this.values[this.length++] = a;
    this.values[this.length++] = b;
    this.values[this.length++] = c;
  }

  /** Returns the numbers. */
  all() {
    return this.values.subarray(0, this.length);
  }
}

/**
 * Returns the squared length of the longest chord that is not divided.
 * @param {number} spacing degrees; 0: no chord is divided
 */
function longestChord(spacing) {
  return spacing > 0 ? (2 * Math.sin((Math.min(spacing, 180) * radiansPerDegree) / 2)) ** 2 : Infinity;
}

/**
 * Returns the squared distance of two points of an array.
 * @param {Float64Array} points x, y, z ...
 * @param {number} a
 * @param {number} b
 */
function squaredChord(points, a, b) {
  const x = points[3 * a] - points[3 * b];
  const y = points[3 * a + 1] - points[3 * b + 1];
  const z = points[3 * a + 2] - points[3 * b + 2];
  return x * x + y * y + z * z;
}

/**
 * Returns the middle of the shorter arc between two points of an array. The sum does not depend on their order.
 * @param {Float64Array} points x, y, z ...
 * @param {number} a
 * @param {number} b
 * @returns {[number, number, number]}
 */
function middle(points, a, b) {
  const x = points[3 * a] + points[3 * b];
  const y = points[3 * a + 1] + points[3 * b + 1];
  const z = points[3 * a + 2] + points[3 * b + 2];
  const length = Math.sqrt(x * x + y * y + z * z);
  return [x / length, y / length, z / length];
}

/**
 * Returns a number of points that the pieces of triangles have at least. Pieces lie outside of their triangle, so that
 * their areas have no smaller sum; none is larger than the equilateral triangle with the longest sides; and a surface on
 * the sphere has one vertex for two triangles, or more.
 * @param {Float64Array} points
 * @param {Uint32Array} triangles
 * @param {number} longest the squared length of the longest sides
 */
function leastPoints(points, triangles, longest) {
  let area = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]];
    const [p, q, r] = [squaredChord(points, a, b), squaredChord(points, b, c), squaredChord(points, c, a)];
    area += Math.sqrt(Math.max(0, 4 * p * q - (p + q - r) ** 2)) / 4; // Heron
  }
  return area === 0 ? 0 : area / ((Math.sqrt(3) / 4) * longest) / 2;
}

/**
 * Divides triangles whose sides are longer than the spacing, at the middles of these sides.
 * @param {Float64Array} points unit vectors, x, y, z ...
 * @param {Uint32Array} triangles three positions in points each
 * @param {number} spacing degrees; 0: nothing is divided
 * @returns {{points: Float64Array, triangles: Uint32Array, parents: Uint32Array}} points, with the new ones behind the
 *   given ones; `parents` has for each new point the two whose middle it is, which come before it
 */
export function refineTriangles(points, triangles, spacing) {
  const longest = longestChord(spacing);
  const isFine = spacing > 0 && spacing < 0.06; // coarser ones are few enough: 13 million for all of the sphere
  if (isFine && leastPoints(points, triangles, longest) > mostPoints + points.length / 3) throw tooFine(spacing);
  const all = new Growing(points);
  const parents = new Growing(new Uint32Array(0));
  /** @type {Map<number, number>} */
  const middles = new Map();
  const numGiven = points.length / 3;
  /** The middle of a side, or -1 if the side stays. @param {number} a @param {number} b */
  const divided = (a, b) => {
    if (!(squaredChord(/** @type {Float64Array} */ (all.values), a, b) > longest)) return -1;
    const key = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
    let made = middles.get(key);
    if (made === undefined) {
      if (middles.size === mostPoints) throw tooFine(spacing);
      made = all.add(...middle(/** @type {Float64Array} */ (all.values), a, b)) / 3;
      parents.add(a, b);
      middles.set(key, made);
    }
    return made;
  };
  const done = new Growing(new Uint32Array(triangles.length));
  done.length = 0;
  let pending = triangles;
  while (pending.length > 0) {
    const next = new Growing(new Uint32Array(0));
    for (let t = 0; t < pending.length; t += 3) {
      const [a, b, c] = [pending[t], pending[t + 1], pending[t + 2]];
      const [ab, bc, ca] = [divided(a, b), divided(b, c), divided(c, a)];
      if (ab >= 0 || bc >= 0 || ca >= 0) addPieces([a, b, c], [ab, bc, ca], next);
      else if (done.length + 3 <= done.values.length) done.addHere(a, b, c);
      else done.add(a, b, c);
    }
    pending = /** @type {Uint32Array} */ (next.all());
  }
  const isSame = all.length / 3 === numGiven;
  return {
    points: isSame ? points : /** @type {Float64Array} */ (all.all()),
    triangles: isSame ? triangles : /** @type {Uint32Array} */ (done.all()),
    parents: /** @type {Uint32Array} */ (parents.all()),
  };
}

/**
 * Adds the pieces of a triangle to those that are looked at again.
 * @param {[number, number, number]} corners
 * @param {[number, number, number]} middles of the sides behind each corner, -1 for sides that stay; one is divided
 * @param {Growing} next
 */
function addPieces(corners, middles, next) {
  const number = middles.filter((m) => m >= 0).length;
  // The corners are turned until the sides that are divided come first, so that each number has one picture.
  let turn = 0;
  if (number === 1) turn = middles.findIndex((m) => m >= 0);
  if (number === 2) turn = (middles.findIndex((m) => m < 0) + 1) % 3;
  const [a, b, c] = [0, 1, 2].map((k) => corners[(k + turn) % 3]);
  const [ab, bc, ca] = [0, 1, 2].map((k) => middles[(k + turn) % 3]);
  if (number === 1) next.add(a, ab, c, ab, b, c);
  if (number === 2) next.add(a, ab, c, ab, b, bc, ab, bc, c);
  if (number === 3) next.add(a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca);
}

/**
 * Divides arcs that are longer than the spacing.
 * @param {Float64Array} segments six numbers for each arc, the unit vectors of its ends
 * @param {number} spacing degrees; 0: nothing is divided
 * @returns {{segments: Float64Array, origins: Uint32Array | undefined}} the pieces, and the arc that each is of;
 *   undefined if all are as they were
 */
export function refineSegments(segments, spacing) {
  const longest = longestChord(spacing);
  const n = segments.length / 6;
  let isAnyLong = false;
  for (let s = 0; s < n && !isAnyLong; ++s) isAnyLong = squaredChord(segments, 2 * s, 2 * s + 1) > longest;
  if (!isAnyLong) return { segments, origins: undefined };
  let total = 0;
  for (let s = 0; s < n; ++s) total += Math.sqrt(squaredChord(segments, 2 * s, 2 * s + 1));
  if (total / Math.sqrt(longest) > mostPoints) throw tooFine(spacing);
  const pieces = new Growing(new Float64Array(0));
  const origins = new Growing(new Uint32Array(0));
  /** @param {number[]} ends @param {number} origin */
  const add = (ends, origin) => {
    const both = Float64Array.from(ends);
    if (!(squaredChord(both, 0, 1) > longest)) {
      pieces.add(...ends);
      origins.add(origin);
      return;
    }
    const m = middle(both, 0, 1);
    add([...ends.slice(0, 3), ...m], origin);
    add([...m, ...ends.slice(3)], origin);
  };
  for (let s = 0; s < n; ++s) add(Array.from(segments.subarray(6 * s, 6 * s + 6)), s);
  return {
    segments: /** @type {Float64Array} */ (pieces.all()),
    origins: /** @type {Uint32Array} */ (origins.all()),
  };
}
