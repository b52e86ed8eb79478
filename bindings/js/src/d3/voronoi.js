// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// geoVoronoi() of d3-geo-voronoi 2.1.

import { callable, number, shown } from "../arguments.js";
import { RondelError } from "../errors.js";
import { geoDelaunay } from "./delaunay.js";
import { centroid, distance, isPlace, partOf } from "./sphere.js";

/** @typedef {import("./sphere.js").LonLat} LonLat */

/** @param {any} datum @param {0 | 1} k @param {number} index of the datum */
function coordinate(datum, k, index) {
  const part = partOf(datum, k, "datum", index);
  if ("type" in datum) return centroid(datum, index)[k];
  if (Array.isArray(datum) || 0 in datum) return part;
  throw new RondelError(`datum ${index} is neither an array nor GeoJSON, and needs x() and y()`, index);
}

/** The data in what a user gave; nothing without data. @param {any} data @returns {any[] | undefined} */
function listed(data) {
  if (data === undefined || data === null) return undefined;
  const list = data.type === "FeatureCollection" ? data.features : data;
  if (Array.isArray(list)) return list;
  throw new TypeError(`data: an array or a FeatureCollection is wanted, not ${shown(data)}`);
}

/** @param {any[]} features */
const collection = (features) => ({ type: "FeatureCollection", features });

/** @param {any} geometry @param {object} properties */
const feature = (geometry, properties) => ({ type: "Feature", geometry, properties });

/** @param {any[]} ring */
const closed = (ring) => [...ring, ring[0]];

/**
 * The Voronoi diagram of data: points [longitude, latitude], GeoJSON objects, which stand for their centroids, or what
 * x() and y() read. Data without finite coordinates are left out. All methods may be called with new data.
 * @param {any} [data] an array or a FeatureCollection
 * @returns {any} a function of data that returns itself, with the methods of d3-geo-voronoi
 */
export function geoVoronoi(data) {
  let reading = 0; // the datum, for messages: d3 passes no more than the datum to x() and y()
  /** @type {any} */
  const v = (/** @type {any} */ newData) => {
    const list = listed(newData);
    /** @type {LonLat[]} */
    const points = [];
    const valid = [];
    for (reading = 0; list && reading < list.length; ++reading) {
      const datum = list[reading];
      const [x, y] = [v._vx(datum), v._vy(datum)];
      if (!isPlace(x, y, "datum", reading)) continue;
      points.push([x, y]);
      valid.push(datum);
    }
    const delaunay = list ? geoDelaunay(points) : null;
    Object.assign(v, { _data: list, points, valid, delaunay });
    return v;
  };
  v._vx = (/** @type {any} */ d) => coordinate(d, 0, reading);
  v._vy = (/** @type {any} */ d) => coordinate(d, 1, reading);
  addAccessors(v);
  addDiagram(v);
  addQuestions(v);
  return data === undefined ? v : v(data);
}

/** @param {any} v */
function addAccessors(v) {
  v.x = (/** @type {any} */ f) => (f === undefined ? v._vx : ((v._vx = callable(f, "x")), v));
  v.y = (/** @type {any} */ f) => (f === undefined ? v._vy : ((v._vy = callable(f, "y")), v));
}

// Adds a method that takes new data if it is given some, and returns false without data.
/** @param {any} v @param {string} name @param {() => any} make */
function addMethod(v, name, make) {
  v[name] = (/** @type {any} */ data) => {
    if (data !== undefined) v(data);
    return v.delaunay ? make() : false;
  };
}

/** @param {number[] | undefined} polygon @param {LonLat[]} centers */
function polygonOf(polygon, centers) {
  if (!polygon) return null;
  const ring = new Array(polygon.length + 1);
  for (let i = 0; i < polygon.length; ++i) ring[i] = centers[polygon[i]];
  ring[polygon.length] = ring[0];
  return { type: "Polygon", coordinates: [ring] };
}

/** @param {any} v */
function addDiagram(v) {
  addMethod(v, "polygons", () => {
    const { delaunay, points, valid } = v;
    const { centers, polygons, neighbors } = delaunay;
    const features = [];
    for (let i = 0; i < points.length; ++i) {
      const geometry = polygons.length > 0 ? polygonOf(polygons[i], centers) : i === 0 ? { type: "Sphere" } : null;
      features.push(feature(geometry, { site: valid[i], sitecoordinates: points[i], neighbours: neighbors[i] }));
    }
    return collection(features);
  });
  addMethod(v, "cellMesh", () => {
    const { centers, mesh } = v.delaunay;
    const coordinates = mesh.map((/** @type {[number, number]} */ [p, q]) => [centers[p], centers[q]]);
    return { type: "MultiLineString", coordinates };
  });
  addMethod(v, "triangles", () => {
    const { centers, triangles, isGhost } = v.delaunay;
    const features = [];
    for (let t = 0; t < triangles.length; ++t) {
      if (isGhost[t]) continue;
      const ring = triangles[t].map((/** @type {number} */ i) => v.points[i]);
      features.push(feature({ type: "Polygon", coordinates: [closed(ring)] }, { circumcenter: centers[t] }));
    }
    return collection(features);
  });
}

/** @param {any} v */
function addQuestions(v) {
  /** @param {[number, number]} edge */
  const ends = ([a, b]) => [v.points[a], v.points[b]];
  addMethod(v, "links", () => {
    const { edges, urquhart } = v.delaunay;
    const lengths = edges.map((/** @type {[number, number]} */ [a, b]) => distance(v.points[a], v.points[b]));
    const isInUrquhart = urquhart(lengths);
    return collection(
      edges.map((/** @type {[number, number]} */ edge, /** @type {number} */ i) =>
        feature(
          { type: "LineString", coordinates: ends(edge) },
          { source: v.valid[edge[0]], target: v.valid[edge[1]], length: lengths[i], urquhart: isInUrquhart[i] },
        ),
      ),
    );
  });
  addMethod(v, "mesh", () => ({ type: "MultiLineString", coordinates: v.delaunay.edges.map(ends) }));
  addMethod(v, "hull", () => {
    const { hull } = v.delaunay;
    if (hull.length === 0) return null;
    return { type: "Polygon", coordinates: [closed(hull.map((/** @type {number} */ i) => v.points[i]))] };
  });
  // The radius is in radians, in spite of the README of d3-geo-voronoi; farther sites give undefined.
  v.find = (/** @type {number} */ lon, /** @type {number} */ lat, /** @type {number} */ radius) => {
    if (radius !== undefined) number(radius, "radius", 0);
    v._found = v.delaunay?.find(lon, lat, v._found);
    const place = v.points?.[v._found];
    return place && (!radius || distance([lon, lat], place) < radius) ? v._found : undefined;
  };
}
