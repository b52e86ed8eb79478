// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points of the sphere as d3-geo has them: [longitude, latitude] in degrees.

import { shown } from "../arguments.js";
import { RondelError } from "../errors.js";
import { checkGeoJson } from "../polygons/geojson.js";

/** @typedef {[number, number]} LonLat longitude and latitude in degrees */
/** @typedef {[number, number, number]} Vector */

const degree = Math.PI / 180;

/** @param {Vector} a @param {Vector} b */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** @param {Vector} a @param {Vector} b @returns {Vector} */
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** @param {ArrayLike<number>} p @returns {Vector} */
export function toVector(p) {
  const cosine = Math.cos(p[1] * degree);
  return [cosine * Math.cos(p[0] * degree), cosine * Math.sin(p[0] * degree), Math.sin(p[1] * degree)];
}

/** Returns the position of a vector of any length. @param {number} x @param {number} y @param {number} z @returns {LonLat} */
export function toLonLat(x, y, z) {
  return [Math.atan2(y, x) / degree, Math.atan2(z, Math.sqrt(x * x + y * y)) / degree];
}

/** The angle between two points in radians, precise for close ones. @param {ArrayLike<number>} p @param {ArrayLike<number>} q */
export function distance(p, q) {
  const [a, b] = [toVector(p), toVector(q)];
  const normal = cross(a, b);
  return Math.atan2(Math.sqrt(dot(normal, normal)), dot(a, b));
}

/** The point at the fraction t of the arc from p to q. @param {LonLat} p @param {LonLat} q @param {number} t @returns {LonLat} */
export function interpolate(p, q, t) {
  if (t === 0 || (p[0] === q[0] && p[1] === q[1])) return p;
  if (t === 1) return q;
  const angle = distance(p, q);
  const [a, b] = [toVector(p), toVector(q)];
  const [s, r] = [Math.sin((1 - t) * angle), Math.sin(t * angle)];
  return toLonLat(s * a[0] + r * b[0], s * a[1] + r * b[1], s * a[2] + r * b[2]);
}

/**
 * Throws if a value is neither a number nor missing, as d3 has data without coordinates.
 * @param {any} value
 * @param {string} what
 * @param {string} word
 * @param {number} index
 */
function checkNumber(value, what, word, index) {
  if (typeof value === "number" || value === undefined || value === null) return;
  throw new RondelError(`${word} ${index}: the ${what} is ${shown(value)}, not a number`, index);
}

/** Whether there is such a place. @param {any} lon @param {any} lat @param {string} word @param {number} index */
export function isPlace(lon, lat, word, index) {
  if (typeof lon === "number" && typeof lat === "number") return Number.isFinite(lon + lat);
  checkNumber(lon, "longitude", word, index);
  checkNumber(lat, "latitude", word, index);
  return false;
}

/**
 * Reads number k of an element of an array of arrays.
 * @param {any} element
 * @param {number} k
 * @param {string} word
 * @param {number} index
 */
export function partOf(element, k, word, index) {
  if (typeof element === "object" && element !== null) return element[k];
  throw new RondelError(`${word} ${index} is ${shown(element)}, not an array such as [longitude, latitude]`, index);
}

/** The same place with a latitude in [-90, 90]: beyond a pole a meridian goes on. @param {number} lon @param {number} lat @returns {LonLat} */
export function withinPoles(lon, lat) {
  if (Math.abs(lat) <= 90) return [lon, lat];
  const turned = lat - 360 * Math.round(lat / 360);
  if (Math.abs(turned) <= 90) return [lon, turned];
  return [lon + 180, Math.sign(turned) * 180 - turned];
}

/** Coordinates, and arrays of them. @param {any} positions @param {(p: LonLat) => void} visit */
function eachPosition(positions, visit) {
  if (typeof positions[0] === "number") visit(positions);
  else for (const inner of positions) eachPosition(inner, visit);
}

// Sums by dimension: of points, of arcs weighted by length, of areas (half the sum of length times normal).
class Moments {
  /** @type {[Vector, Vector, Vector]} */
  sums = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];

  /** @param {number} dimension @param {Vector} v @param {number} factor */
  add(dimension, v, factor) {
    for (let i = 0; i < 3; ++i) this.sums[dimension][i] += factor * v[i];
  }

  /** @param {LonLat[]} line @param {boolean} isRing */
  addLine(line, isRing) {
    const points = line.map(toVector);
    for (let i = 1; i < points.length; ++i) {
      const [p, q] = [points[i - 1], points[i]];
      const normal = cross(p, q);
      const sine = Math.sqrt(dot(normal, normal));
      const length = Math.atan2(sine, dot(p, q));
      this.add(1, [p[0] + q[0], p[1] + q[1], p[2] + q[2]], length);
      if (isRing && sine > 0) this.add(2, normal, -length / sine); // clockwise around what is inside
    }
  }

  /** @param {any} object GeoJSON */
  addObject(object) {
    if (!object) return;
    const { type, coordinates } = object;
    if (type === "FeatureCollection") for (const f of object.features) this.addObject(f);
    else if (type === "GeometryCollection") for (const g of object.geometries) this.addObject(g);
    else if (type === "Feature") this.addObject(object.geometry);
    else if (type === "LineString") this.addLine(coordinates, false);
    else if (type === "MultiLineString") for (const line of coordinates) this.addLine(line, false);
    else if (type === "Polygon") for (const ring of coordinates) this.addLine(ring, true);
    else if (type === "MultiPolygon") for (const p of coordinates) for (const ring of p) this.addLine(ring, true);
    if (coordinates) eachPosition(coordinates, (p) => this.add(0, toVector(p), 1));
  }
}

/**
 * Returns the center of mass of a GeoJSON object: of its areas, or if it has none of its lines, or of its points.
 * @param {any} object
 * @param {number} index of the datum, for messages
 * @returns {LonLat} NaN where there is none
 */
export function centroid(object, index) {
  checkGeoJson(object, { word: "datum", index });
  const geometry = object.type === "Feature" ? object.geometry : object;
  if (geometry?.type === "Point") return [geometry.coordinates[0], geometry.coordinates[1]];
  const moments = new Moments();
  moments.addObject(object);
  const sum = moments.sums.reverse().find((v) => dot(v, v) > 1e-24);
  return sum ? toLonLat(...sum) : [NaN, NaN];
}
