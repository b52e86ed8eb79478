// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The polygons of GeoJSON as flat arrays.

import { named, shown } from "../arguments.js";
import { RondelError } from "../errors.js";

/**
 * Polygon p of all has the rings polygons[p] ... polygons[p + 1] - 1, ring r the positions rings[r] ... rings[r + 1] - 1,
 * and feature f the polygons features[f] ... features[f + 1] - 1. `isSphere` tells the features that are the whole sphere.
 * @typedef {{features: number[], polygons: number[], rings: number[], lonLat: Float64Array, isSphere: boolean[]}} FlatPolygons
 */

/** How deep the positions of a geometry lie. @type {Record<string, number>} */
const depths = { Point: 0, MultiPoint: 1, LineString: 1, MultiLineString: 2, Polygon: 2, MultiPolygon: 3 };

/**
 * The place of a geometry in what was passed, such as "feature" 3: messages begin with it.
 * @typedef {{word: string, index: number}} Place
 */

/** @param {Place} place @param {string} flaw */
const flawed = ({ word, index }, flaw) => new RondelError(`${word} ${index}: ${flaw}`, index);

/** @param {any} position */
const isPosition = (position) =>
  (Array.isArray(position) || ArrayBuffer.isView(position)) &&
  typeof (/** @type {any} */ (position)[0]) === "number" &&
  typeof (/** @type {any} */ (position)[1]) === "number";

const mostNested = 100; // RFC 7946 advises against any; a collection may hold itself

/** @param {number} depth @param {Place} place */
function checkDepth(depth, place) {
  if (depth > mostNested) throw flawed(place, `collections lie in each other more than ${mostNested} times`);
}

/**
 * Returns what is an array in valid GeoJSON.
 * @param {any} value
 * @param {string} name
 * @param {Place} place
 * @returns {any[]}
 */
function arrayOf(value, name, place) {
  if (Array.isArray(value)) return value;
  throw flawed(place, `${name} has ${shown(value)} in place of an array`);
}

/** @param {any} coordinates @param {number} depth @param {Place} place */
function checkCoordinates(coordinates, depth, place) {
  if (depth > 0) for (const inner of arrayOf(coordinates, "coordinates", place)) checkCoordinates(inner, depth - 1, place);
  else if (!isPosition(coordinates)) throw flawed(place, `${shown(coordinates)} is no [longitude, latitude]`);
}

/** Throws if this is none of the geometries that have coordinates. @param {any} geometry @param {Place} place */
function checkGeometry(geometry, place) {
  const { type, coordinates } = geometry ?? {};
  if (!Object.hasOwn(depths, type)) throw flawed(place, `${shown(type ?? geometry)} is no geometry of GeoJSON`);
  checkCoordinates(coordinates, depths[type], place);
}

/**
 * Throws if an object is no GeoJSON; null, for no geometry, and {type: "Sphere"} are some.
 * @param {any} object
 * @param {Place} place
 * @param {number} [depth] in collections
 */
export function checkGeoJson(object, place, depth = 0) {
  if (object === null || object?.type === "Sphere") return;
  checkDepth(depth, place);
  const { type, features, geometries, geometry } = object ?? {};
  const check = (/** @type {any} */ part) => checkGeoJson(part, place, depth + 1);
  if (type === "FeatureCollection") for (const feature of arrayOf(features, "features", place)) check(feature);
  else if (type === "GeometryCollection") for (const part of arrayOf(geometries, "geometries", place)) check(part);
  else if (type === "Feature") check(geometry);
  else checkGeometry(object, place);
}

/**
 * Writes the positions of a ring.
 * @param {any[]} ring
 * @param {Place} place
 * @param {Float64Array} lonLat
 * @param {number} begin of its first number
 */
function placeRing(ring, place, lonLat, begin) {
  for (const position of ring) {
    if (!isPosition(position)) throw flawed(place, `${shown(position)} is no [longitude, latitude]`);
    const lon = position[0];
    const lat = position[1];
    if (!(Math.abs(lat) <= 90)) throw flawed(place, `latitude ${lat} is outside [-90, 90]`);
    if (!Number.isFinite(lon)) throw flawed(place, `longitude ${lon} is not finite`);
    lonLat[begin++] = lon;
    lonLat[begin++] = lat;
  }
}

/**
 * @param {any} rings of a polygon
 * @param {Place} place
 * @param {FlatPolygons} flat
 */
function addPolygon(rings, place, flat) {
  if (!Array.isArray(rings) || !rings.every(Array.isArray)) {
    throw flawed(place, "the coordinates of a polygon are an array of rings");
  }
  for (const ring of rings) {
    const first = flat.rings[flat.rings.length - 1];
    const end = first + ring.length;
    if (2 * end > flat.lonLat.length) {
      const longer = new Float64Array(Math.max(4 * first, 2 * end));
      longer.set(flat.lonLat.subarray(0, 2 * first));
      flat.lonLat = longer;
    }
    placeRing(ring, place, flat.lonLat, 2 * first);
    flat.rings.push(end);
  }
  flat.polygons.push(flat.rings.length - 1);
}

/**
 * @param {any} geometry
 * @param {Place} place
 * @param {FlatPolygons} flat
 * @param {number} [depth] in collections
 */
function addGeometry(geometry, place, flat, depth = 0) {
  const { type, coordinates, geometries } = geometry ?? {};
  if (type === "Sphere") flat.isSphere[place.index] = true;
  else if (type === "Polygon") addPolygon(coordinates, place, flat);
  else if (type === "MultiPolygon") {
    for (const rings of arrayOf(coordinates, "coordinates", place)) addPolygon(rings, place, flat);
  } else if (type === "GeometryCollection") {
    checkDepth(depth, place);
    for (const part of arrayOf(geometries, "geometries", place)) addGeometry(part, place, flat, depth + 1);
  } else if (geometry !== null) checkGeometry(geometry, place);
}

/**
 * Returns the polygons of an object: a feature for each of a FeatureCollection, one for any other object.
 * @param {any} object
 * @returns {FlatPolygons}
 */
export function flatPolygons(object) {
  named(object, undefined, "object");
  const features = object.type === "FeatureCollection" ? object.features : [object];
  if (!Array.isArray(features)) throw new TypeError(`object: features has ${shown(features)} in place of an array`);
  /** @type {FlatPolygons} */
  const flat = { features: [0], polygons: [0], rings: [0], lonLat: new Float64Array(1024), isSphere: [] };
  for (let index = 0; index < features.length; ++index) {
    const item = features[index] ?? undefined; // null is no feature
    flat.isSphere.push(false);
    addGeometry(item?.type === "Feature" ? item.geometry : item, { word: "feature", index }, flat);
    flat.features.push(flat.polygons.length - 1);
  }
  flat.lonLat = flat.lonLat.subarray(0, 2 * flat.rings[flat.rings.length - 1]);
  return flat;
}
