// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The polygons of GeoJSON as flat arrays.

import { RondelError } from "../errors.js";

/**
 * Polygon p of all has the rings polygons[p] ... polygons[p + 1] - 1, ring r the positions rings[r] ... rings[r + 1] - 1,
 * and feature f the polygons features[f] ... features[f + 1] - 1. `isSphere` tells the features that are the whole sphere.
 * @typedef {{features: number[], polygons: number[], rings: number[], lonLat: Float64Array, isSphere: boolean[]}} FlatPolygons
 */

const withoutInside = ["Point", "MultiPoint", "LineString", "MultiLineString"];

/**
 * Writes the positions of a ring.
 * @param {any[]} ring
 * @param {number} feature
 * @param {Float64Array} lonLat
 * @param {number} place of the first number
 */
function placeRing(ring, feature, lonLat, place) {
  for (const position of ring) {
    const isArray = Array.isArray(position) || ArrayBuffer.isView(position);
    const lon = isArray ? /** @type {any} */ (position)[0] : undefined;
    const lat = isArray ? /** @type {any} */ (position)[1] : undefined;
    if (typeof lon !== "number" || typeof lat !== "number") {
      throw new RondelError(`feature ${feature}: ${JSON.stringify(position)} is no [longitude, latitude]`, feature);
    }
    lonLat[place++] = lon;
    lonLat[place++] = lat;
  }
}

/**
 * @param {any} rings of a polygon
 * @param {number} feature
 * @param {FlatPolygons} flat
 */
function addPolygon(rings, feature, flat) {
  if (!Array.isArray(rings) || !rings.every(Array.isArray)) {
    throw new RondelError(`feature ${feature}: the coordinates of a polygon are an array of rings`, feature);
  }
  for (const ring of rings) {
    const first = flat.rings[flat.rings.length - 1];
    const end = first + ring.length;
    if (2 * end > flat.lonLat.length) {
      const longer = new Float64Array(Math.max(4 * first, 2 * end));
      longer.set(flat.lonLat.subarray(0, 2 * first));
      flat.lonLat = longer;
    }
    placeRing(ring, feature, flat.lonLat, 2 * first);
    flat.rings.push(end);
  }
  flat.polygons.push(flat.rings.length - 1);
}

/**
 * @param {any} geometry
 * @param {number} feature
 * @param {FlatPolygons} flat
 */
function addGeometry(geometry, feature, flat) {
  if (geometry === null || geometry === undefined || withoutInside.includes(geometry.type)) return;
  const { type, coordinates, geometries } = geometry;
  if (type === "Sphere") flat.isSphere[feature] = true;
  else if (type === "Polygon") addPolygon(coordinates, feature, flat);
  else if (type === "MultiPolygon" && Array.isArray(coordinates)) {
    for (const rings of coordinates) addPolygon(rings, feature, flat);
  } else if (type === "GeometryCollection" && Array.isArray(geometries)) {
    for (const part of geometries) addGeometry(part, feature, flat);
  } else throw new RondelError(`feature ${feature}: ${JSON.stringify(type)} is no geometry of GeoJSON`, feature);
}

/**
 * Returns the polygons of an object: a feature for each of a FeatureCollection, one for any other object.
 * @param {any} object
 * @returns {FlatPolygons}
 */
export function flatPolygons(object) {
  if (object === null || typeof object !== "object") throw new TypeError("an object of GeoJSON is wanted");
  const features = object.type === "FeatureCollection" ? object.features : [object];
  if (!Array.isArray(features)) throw new TypeError("a FeatureCollection has an array of features");
  /** @type {FlatPolygons} */
  const flat = { features: [0], polygons: [0], rings: [0], lonLat: new Float64Array(1024), isSphere: [] };
  features.forEach((item, feature) => {
    flat.isSphere.push(false);
    addGeometry(item?.type === "Feature" ? item.geometry : item, feature, flat);
    flat.features.push(flat.polygons.length - 1);
  });
  flat.lonLat = flat.lonLat.subarray(0, 2 * flat.rings[flat.rings.length - 1]);
  return flat;
}
