// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// geoContour() of d3-geo-voronoi 2.1: lines and bands of equal value, linear along the edges of the triangulation.
//
// A triangle that has vertices of both kinds, high (value >= threshold) and low, is crossed by one segment, which
// enters through the halfedge from low to high. The way goes on behind the edge from high to low; what is high lies
// on the right, so that the ring surrounds it clockwise. The surface is closed, and so is every ring.

import { callable, finiteNumbers, number, shown } from "../arguments.js";
import { RondelError } from "../errors.js";
import { geoDelaunay } from "./delaunay.js";
import { following } from "./planar.js";
import { interpolate, partOf } from "./sphere.js";
import { niceTicks } from "./ticks.js";

/** @typedef {import("./sphere.js").LonLat} LonLat */
/** @typedef {{triangles: ArrayLike<number>, halfedges: ArrayLike<number>}} Surface */

const defaultTicks = 10;

/**
 * The rings of a threshold.
 * @param {Surface} surface
 * @param {number[]} values
 * @param {number} threshold
 * @param {(i: number, j: number, t: number) => LonLat} pointBetween
 */
function ringsOf({ triangles, halfedges }, values, threshold, pointBetween) {
  /** @param {number} h */
  const rises = (h) => values[triangles[h]] < threshold && values[triangles[following(h)]] >= threshold;
  const isVisited = new Uint8Array(triangles?.length ?? 0);
  const rings = [];
  for (let first = 0; first < isVisited.length; ++first) {
    if (isVisited[first] || !rises(first)) continue;
    const ring = [];
    let h = first;
    do {
      isVisited[h] = 1;
      const [i, j] = [triangles[h], triangles[following(h)]];
      ring.push(pointBetween(i, j, (threshold - values[i]) / (values[j] - values[i])));
      const isThirdHigh = values[triangles[following(following(h))]] >= threshold;
      h = halfedges[isThirdHigh ? following(following(h)) : following(h)];
    } while (h !== first);
    ring.push(ring[0]);
    rings.push(ring);
  }
  return rings;
}

class Contour {
  /** @type {any} */ x = (/** @type {any} */ d, /** @type {number} */ i) => partOf(d, 0, "datum", i);
  /** @type {any} */ y = (/** @type {any} */ d, /** @type {number} */ i) => partOf(d, 1, "datum", i);
  /** @type {any} */ value = (/** @type {any} */ d, /** @type {number} */ i) => partOf(d, 2, "datum", i);
  /** @type {any} */ thresholds = undefined;
  /** @type {any} */ ringsort = (/** @type {any[]} */ rings) => [rings];
  /** @type {any} */ triangulate = undefined;
  /** @type {any} */ pointInterpolate = undefined;
  /** @type {any} */ surface = undefined;
  /** @type {number[]} */ values = [];
  /** @type {LonLat[]} */ points = [];

  /** @param {any[]} data */
  read(data) {
    if (!Array.isArray(data)) throw new TypeError(`data: an array is wanted, not ${shown(data)}`);
    this.values = Array.from(data, (d, i) => this.value(d, i));
    const bad = this.values.findIndex((v) => !Number.isFinite(v));
    if (bad >= 0) throw new RondelError(`datum ${bad}: the value is ${shown(this.values[bad])}, not a finite number`, bad);
    this.points = Array.from(data, (d, i) => /** @type {LonLat} */ ([this.x(d, i), this.y(d, i)]));
    this.surface = this.triangulate ? this.triangulate(data, this.x, this.y) : geoDelaunay(this.points).delaunay;
    if (!this.surface) throw new TypeError(`triangulate returned ${shown(this.surface)}, not a triangulation`);
    if (typeof this.thresholds === "object") return this.thresholds;
    const ends = this.values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
    return niceTicks(ends[0], ends[1], this.thresholds ?? defaultTicks);
  }

  /** @param {number} threshold */
  rings(threshold) {
    const between =
      this.pointInterpolate ??
      ((/** @type {number} */ i, /** @type {number} */ j, /** @type {number} */ t) =>
        interpolate(this.points[i], this.points[j], t));
    return ringsOf(this.surface, this.values, threshold, between);
  }

  /** @param {any[]} data */
  *contours(data) {
    for (const threshold of this.read(data)) yield this.line(threshold);
  }

  /** @param {number} threshold */
  line(threshold) {
    return { type: "MultiPolygon", coordinates: this.ringsort(this.rings(threshold)), value: threshold };
  }

  /** @param {any[]} data */
  *isobands(data) {
    let lower;
    for (const valueMax of this.read(data)) {
      const rings = this.rings(valueMax);
      if (lower) {
        const holes = rings.map((ring) => ring.slice().reverse());
        yield { type: "MultiPolygon", coordinates: this.ringsort([...lower.rings, ...holes]), value: lower.value, valueMax };
      }
      lower = { rings, value: valueMax };
    }
  }
}

/** How many thresholds, or which. @param {any} wanted */
function thresholdsFrom(wanted) {
  if (typeof wanted === "number") number(wanted, "thresholds", 1, 1e6);
  else finiteNumbers(wanted, "thresholds");
  return wanted;
}

/**
 * A generator of contours: a function of data that returns an array of MultiPolygons, each with its `value`. Data are
 * [longitude, latitude, value], or what x(), y() and value() read.
 * @throws {RondelError} when it is called, for the first datum that has no finite value
 * @returns {any} with the methods contour(data, threshold), contours(data), isobands(data), x, y, value, thresholds,
 *   triangulate, pointInterpolate and ringsort of d3-tricontour
 */
export function geoContour() {
  const state = new Contour();
  /** @type {any} */
  const contours = (/** @type {any[]} */ data) => [...state.contours(data)];
  for (const name of ["x", "y", "value", "thresholds", "triangulate", "pointInterpolate", "ringsort"]) {
    const settings = /** @type {Record<string, any>} */ (/** @type {unknown} */ (state));
    const checked = name === "thresholds" ? thresholdsFrom : callable;
    contours[name] = (/** @type {any} */ wanted) =>
      wanted === undefined ? settings[name] : ((settings[name] = checked(wanted, name)), contours);
  }
  contours.contours = (/** @type {any[]} */ data) => state.contours(data);
  contours.isobands = (/** @type {any[]} */ data) => state.isobands(data);
  contours.contour = (/** @type {any[]} */ data, /** @type {number} */ threshold) => {
    number(threshold, "threshold", -Infinity);
    state.read(data);
    return state.line(threshold);
  };
  contours._values = () => state.values;
  contours._triangulation = () => state.surface;
  return contours;
}
