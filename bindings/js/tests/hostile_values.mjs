// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Kinds of parameters. Each has a right value `good`, values that mean the same, and wrong ones, {value, index, words}:
// where there is an index, the error is a RondelError with it, and the message has one of the words. Where there are no
// words, those of the parameter hold, which called() gives.

import { randomNumbers } from "./support.mjs";

const random = randomNumbers(1);
const below = (n) => Math.floor(n * random());

/** @param {any[]} values @param {number} [index] @param {string[]} [words] */
export const wrong = (values, index, words) => values.map((value) => ({ value, index, words }));

/** The kind of a parameter whose messages have one of the words. @param {string} words @param {any} kind */
export const called = (words, kind) => ({ ...kind, words: words.split(" ") });

/** The kind of a parameter that may be left out. */
export const optional = (kind) => ({ ...kind, bad: kind.bad.filter(({ value }) => value !== undefined) });

/** The kind with more wrong values. */
export const and = (kind, ...more) => ({ ...kind, bad: [...kind.bad, ...more] });

function moved() {
  const array = new Float64Array(6);
  structuredClone(array, { transfer: [array.buffer] });
  return array;
}

const withoutNames = Object.create(null);
const texts = ["", "7", "1,0,0", "NaN", "[1, 0, 0]", "x".repeat(1000), "\n"];
const functions = [() => 0, class {}, Math.max];
const numbers = [7, NaN];
const arrayLike = Object.freeze({ toString: null, length: 3, 0: 1 });

/** Values that are no numbers, no arrays, and no objects of options. */
const oddities = [
  ...[undefined, null, true, false, 7n, Symbol("s"), new Date(0), new Map([[1, 2]]), /x/, new DataView(new ArrayBuffer(24))],
  ...[new ArrayBuffer(24), new Boolean(true), new WeakMap(), new Set([1]), arrayLike, ...texts],
];
const noNumbers = [null, undefined, true, "1", "", "x", 1n, Symbol("s"), {}, () => 0, new Date(0), new Number(1)];

/** A copy of an array with another element. */
export const replaced = (array, place, value) => Array.from(array, (old, i) => (i === place ? value : old));

function withHole(array, place) {
  const copy = Array.from(array);
  delete copy[place];
  return copy;
}

/** Arrays of other types with the same whole numbers. */
function sameNumbers(array) {
  const types = [Float64Array, Float32Array, Int8Array, Int16Array, Int32Array];
  if (Math.min(...array) >= 0) types.push(Uint8Array, Uint8ClampedArray, Uint16Array, Uint32Array);
  const inside = Float64Array.from([9, ...array, 9]).subarray(1, array.length + 1);
  return [...types.map((Type) => Type.from(array)), inside, Object.freeze([...array])];
}

/** An array with each of the wrong elements somewhere. */
const spoiled = (good, elements, width = 1) =>
  elements.map((element) => {
    const place = below(good.length);
    return { value: replaced(good, place, element), index: Math.floor(place / width) };
  });

const noArrays = [...oddities, ...functions, ...numbers, {}, withoutNames, moved()];
const notFinite = [NaN, Infinity, -Infinity];

/**
 * A flat array of whole numbers, `width` for each element.
 * @param {number[]} good
 * @param {{width?: number, isFinite?: boolean, more?: any[]}} [settings] `more`: other wrong arrays
 */
export function flat(good, { width = 1, isFinite = true, more = [] } = {}) {
  const bad = [...wrong([...noArrays, ...more]), ...spoiled(good, noNumbers, width)];
  if (isFinite) {
    bad.push(...spoiled(good, notFinite, width), ...wrong([Float32Array.from(replaced(good, 0, NaN))], 0));
  }
  bad.push({ value: withHole(good, 0), index: 0 });
  bad.push(...wrong([[[...good]], [[]], [Float64Array.from(good)], BigInt64Array.from(good.map(BigInt))]));
  if (width > 1) {
    const rows = Array.from({ length: good.length / width }, (_, i) => good.slice(width * i, width * i + width));
    bad.push(...wrong([rows]), ...wrong([good.slice(1), Float64Array.from(good.slice(1))], rows.length - 1));
    bad.push(...wrong([[...good, 0]], rows.length));
  }
  return { good, same: sameNumbers(good), bad };
}

/** An array of indices. @param {number[]} good @param {any[]} more other wrong arrays */
export function list(good, more) {
  const bad = [...wrong([...noArrays, ...more]), ...spoiled(good, [...noNumbers, ...notFinite, [1], -1, 0.5, 2 ** 32])];
  bad.push({ value: withHole(good, 0), index: 0 });
  return { good, same: [], bad: [...bad, ...wrong([Int8Array.of(-1), Float32Array.of(0.5), BigUint64Array.of(1n)], 0)] };
}

/** A number. @param {number} good @param {number[]} outside numbers that are out of range */
export const real = (good, outside) => ({
  good,
  same: [],
  bad: wrong([...oddities, ...functions, {}, [], [good], Float64Array.of(good), new Number(good), ...outside]),
});

/** A whole number from 0 on. @param {number} good @param {number[]} [more] */
export const count = (good, more = []) => real(good, [-1, 0.5, ...notFinite, 2 ** 32, 2 ** 53, ...more]);

/** One of some texts, which may be left out. @param {string} good */
export const choice = (good) => ({
  good,
  same: [],
  bad: wrong([...oddities.slice(1), ...functions, ...numbers, 0, [good], { [good]: 1 }, good.toUpperCase(), ` ${good}`], 0),
});

/** @param {Function} good */
export const callback = (good) => ({ good, same: [], bad: wrong([...oddities, ...numbers, 0, {}, []]) });

/** @param {any} good @param {any[]} bad wrong values of its own kind */
export const thing = (good, bad) => ({ good, same: [], bad: [...wrong([...oddities, ...functions, ...numbers]), ...bad] });

/**
 * An object of options; `parts` has the kind of each. Names that are misspelt are wrong.
 * @param {Record<string, any>} parts
 * @param {{needed?: Record<string, any>, isOpen?: boolean}} [settings] `needed` goes with each option; of an open object
 *   other names are not looked at
 */
export function options(parts, { needed = {}, isOpen = false } = {}) {
  const good = { ...Object.fromEntries(Object.entries(parts).map(([name, part]) => [name, part.good])), ...needed };
  const bad = wrong([...oddities, ...functions, ...numbers, [], [good], Float64Array.of(1), new Set([good])]);
  for (const [name, part] of Object.entries(parts)) {
    for (const { value, index } of part.bad) bad.push({ value: { ...good, [name]: value }, index, words: part.words ?? [name] });
    const others = isOpen ? [] : [name.slice(0, -1), `${name}s`, name.toUpperCase(), ` ${name}`];
    for (const other of others) bad.push({ value: { ...needed, [other]: part.good }, words: [other] });
  }
  return { good, same: [], bad };
}

const endless = { type: "GeometryCollection" };
endless.geometries = [endless];

/** Malformed GeoJSON, but for what is no object. */
export const malformed = [
  ...[{}, { type: "Circle" }, { type: 5 }, { type: null }, { type: "toString" }, { type: ["Polygon"] }, { type: "Feature" }],
  ...[5, {}, [1, 2]].map((geometry) => ({ type: "Feature", geometry })),
  { type: "Feature", geometry: { type: "Polygon", coordinates: [[[0, 0], [1, {}]]] } },
  ...[undefined, {}, [{ type: "Circle" }], [5]].map((geometries) => ({ type: "GeometryCollection", geometries })),
  ...[undefined, 5, [], ["1", "2"]].map((coordinates) => ({ type: "Point", coordinates })),
  { type: "MultiPoint", coordinates: [1, 2] },
  ...["[[1, 2]]", [[1, null]]].map((coordinates) => ({ type: "LineString", coordinates })),
  { type: "MultiLineString", coordinates: [[1, 2]] },
  ...[undefined, null, [1, 2], [[1, 2]], [[{ lon: 1, lat: 2 }]]].map((coordinates) => ({ type: "Polygon", coordinates })),
  ...[[1n, 2], [Symbol("s"), 2], ["1", "2"], [], null].map((position) => ({ type: "Polygon", coordinates: [[position]] })),
  ...[undefined, {}, [[[1, 2]]], [5]].map((coordinates) => ({ type: "MultiPolygon", coordinates })),
  ...[endless, { type: "Feature", geometry: endless }],
];
