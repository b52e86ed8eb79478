// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// geoDelaunay() of d3-geo-voronoi 2.1, with properties that are computed when they are first read.

import { count, number, numbersFor, shown } from "../arguments.js";
import { unitVectors, voronoi } from "../build.js";
import { noIndex } from "../located.js";
import { hullOf } from "./hull.js";
import { following, planarView } from "./planar.js";
import { isPlace, partOf, toLonLat, withinPoles } from "./sphere.js";

/** @typedef {import("./sphere.js").LonLat} LonLat */
/** @typedef {[number, number]} Pair */

/**
 * The result of geoDelaunay(). All arrays have positions in the array of points; points that are not finite are ignored.
 * @typedef {object} GeoDelaunay
 * @property {any} delaunay triangles, halfedges, inedges, points and projection, as d3-delaunay has them
 * @property {Pair[]} edges of the triangles that face away from the center, lower index first
 * @property {[number, number, number][]} triangles clockwise seen from outside
 * @property {LonLat[]} centers the circumcenters of the triangles, and further points of polygons
 * @property {number[][]} neighbors of each point
 * @property {(number[] | undefined)[]} polygons positions in centers, clockwise; none for duplicates
 * @property {Pair[]} mesh the sides of the polygons, positions in centers
 * @property {number[]} hull of points that lie in a hemisphere
 * @property {Uint8Array} isGhost which triangles face the center, 1 for those; not of d3-geo-voronoi
 * @property {(distances: import("../arguments.js").Numbers) => boolean[]} urquhart which edges are in the Urquhart graph
 * @property {(lon: number, lat: number, next?: number) => number | undefined} find the nearest point, `next` for a place
 *   that is not finite, undefined without points
 */

// Arcs that are less than 1.4 mrad short of half a circle keep a point in between, since rounding would decide their way.
const leastCosine = -1 + 1e-6;

/**
 * Copies points, with latitudes in [-90, 90]; NaN for those that are not finite.
 * @param {ArrayLike<number>[]} points
 */
function copiedPlaces(points) {
  if (!Array.isArray(points)) throw new TypeError(`points: an array of points is wanted, not ${shown(points)}`);
  const places = new Float64Array(2 * points.length).fill(NaN);
  for (let i = 0; i < points.length; ++i) {
    let lon = partOf(points[i], 0, "point", i);
    let lat = points[i][1];
    if (!isPlace(lon, lat, "point", i)) continue;
    if (Math.abs(lat) > 90) [lon, lat] = withinPoles(lon, lat);
    places[2 * i] = lon;
    places[2 * i + 1] = lat;
  }
  return places;
}

// A program that makes one diagram after the other leaves the garbage collector no time to free their memory in the
// module. So it is freed here for all but the last ones that were asked; another one that is asked is made again.
const mostSites = 250_000; // of those that are kept; the last one is kept whatever its size
const sitesForOne = 250; // as many sites as take the memory that a diagram has beside sites
/** @typedef {import("../triangulation.js").VoronoiDiagram} VoronoiDiagram */

/** The diagram of some sites, while it is kept. */
class KeptDiagram {
  /** The last one that was asked is the last one. @type {Set<KeptDiagram>} */
  static #all = new Set();
  static #numSites = 0;
  /** @type {VoronoiDiagram | undefined} */
  #diagram;
  #lonLat;
  #size;

  /** @param {Float64Array} lonLat */
  constructor(lonLat) {
    this.#lonLat = lonLat;
    this.#size = lonLat.length / 2 + sitesForOne;
  }

  get() {
    const all = KeptDiagram.#all;
    if (this.#diagram) all.delete(this);
    else {
      this.#diagram = voronoi.lonLat(this.#lonLat);
      KeptDiagram.#numSites += this.#size;
    }
    all.add(this);
    for (const oldest of all) {
      if (KeptDiagram.#numSites <= mostSites || oldest === this) break;
      oldest.free();
    }
    return this.#diagram;
  }

  free() {
    if (!this.#diagram) return;
    this.#diagram.free();
    this.#diagram = undefined;
    KeptDiagram.#all.delete(this);
    KeptDiagram.#numSites -= this.#size;
  }
}

/** @type {FinalizationRegistry<KeptDiagram>} */
const forgotten = new FinalizationRegistry((kept) => kept.free());

class LazyDelaunay {
  #kept;

  /** @param {any[]} points */
  constructor(points) {
    /** Longitude and latitude of each point. */
    this.places = copiedPlaces(points);
    this.numPoints = points.length;
    /** @type {number[]} Position of a site among the points. */
    this.positions = [];
    for (let i = 0; i < this.numPoints; ++i) if (!Number.isNaN(this.places[2 * i])) this.positions.push(i);
    this.isWhole = this.positions.length === this.numPoints;
    this.#kept = new KeptDiagram(this.isWhole ? this.places : this.places.filter((value) => !Number.isNaN(value)));
    this.#kept.get(); // throws for what is no point
    forgotten.register(this, this.#kept);
  }

  get diagram() {
    return this.#kept.get();
  }

  /** @param {Uint32Array} sites */
  toPositions(sites) {
    return this.isWhole ? sites : sites.map((site) => this.positions[site]);
  }

  /** The triangulation as planar code wants it. */
  delaunay() {
    if (this.positions.length < 2) return {};
    const { triangles, neighbors } = this.diagram;
    /** @type {LonLat[]} */
    const places = Array.from({ length: this.numPoints }, (_, i) => [this.places[2 * i], this.places[2 * i + 1]]);
    return planarView(places, this.positions[0], this.toPositions(triangles), neighbors);
  }

  /** Corners of the faces as positions. */
  corners() {
    return this.toPositions(this.diagram.triangles);
  }

  triangles() {
    const corners = this.corners();
    /** @type {[number, number, number][]} */
    const result = [];
    for (let i = 0; i < corners.length; i += 3) result.push([corners[i], corners[i + 2], corners[i + 1]]);
    return result;
  }

  isGhost() {
    const isGhost = new Uint8Array(this.diagram.numFaces);
    for (const face of this.diagram.ghostFaces) isGhost[face] = 1;
    return isGhost;
  }

  /** Returns the pairs of neighbors around a great circle. */
  ringPairs() {
    const ring = this.toPositions(this.diagram.ring);
    /** @type {Pair[]} */
    const pairs = [];
    for (let i = 0; i < ring.length; ++i) {
      const j = (i + 1) % ring.length;
      if (ring.length > 2 || i < j) pairs.push([ring[i], ring[j]]);
    }
    return pairs;
  }

  edges() {
    if (this.diagram.dimension < 2) return this.ringPairs().map(([a, b]) => (a < b ? [a, b] : [b, a]));
    const { neighbors } = this.diagram;
    const isGhost = this.isGhost();
    const corners = this.corners();
    /** @type {Pair[]} */
    const result = [];
    for (let h = 0; h < corners.length; ++h) {
      const face = Math.floor(h / 3);
      const across = neighbors[h];
      if (isGhost[face] || (across < face && !isGhost[across])) continue; // each edge once
      const [a, b] = [corners[following(h)], corners[following(following(h))]];
      result.push(a < b ? [a, b] : [b, a]);
    }
    return result;
  }

  centers() {
    const { points } = this.diagram.cells;
    /** @type {LonLat[]} */
    const result = new Array(points.length / 3);
    for (let i = 0; i < result.length; ++i) result[i] = toLonLat(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    return result;
  }

  neighbors() {
    /** @type {number[][]} */
    const result = Array.from({ length: this.numPoints }, () => []);
    const corners = this.corners();
    for (let h = 0; h < corners.length; ++h) result[corners[h]].push(corners[following(h)]);
    if (corners.length === 0) {
      for (const [a, b] of this.ringPairs()) {
        result[a].push(b);
        result[b].push(a);
      }
    }
    return result;
  }

  polygons() {
    if (this.diagram.numVertices < 2) return [];
    const { offsets, rings, points } = this.diagram.cells;
    const { numFaces } = this.diagram;
    /** @param {number} i @param {number} j */
    const cosine = (i, j) =>
      points[3 * i] * points[3 * j] + points[3 * i + 1] * points[3 * j + 1] + points[3 * i + 2] * points[3 * j + 2];
    /** @type {(number[] | undefined)[]} */
    const result = new Array(this.numPoints).fill(undefined);
    for (let site = 0; site < this.positions.length; ++site) {
      const [begin, end] = [offsets[site], offsets[site + 1]];
      if (begin === end) continue;
      const ring = [];
      let numCenters = 0;
      for (let i = begin; i < end; ++i) if (rings[i] < numFaces) ++numCenters;
      for (let i = end - 1; i >= begin; --i) {
        const before = rings[i === begin ? end - 1 : i - 1];
        const after = rings[i + 1 === end ? begin : i + 1];
        // The library divides arcs of more than 120 degrees; d3-geo needs points only in longer ones.
        const isBend = rings[i] >= numFaces && before < numFaces && after < numFaces;
        if (isBend && numCenters > 2 && cosine(before, after) > leastCosine) continue;
        ring.push(rings[i]);
      }
      result[this.positions[site]] = ring;
    }
    return result;
  }

  /** @param {(number[] | undefined)[]} polygons */
  mesh(polygons) {
    /** @type {Pair[]} */
    const result = [];
    for (const polygon of polygons) {
      if (!polygon) continue;
      let p = polygon[polygon.length - 1];
      for (const q of polygon) {
        if (q > p) result.push([p, q]);
        p = q;
      }
    }
    return result;
  }

  hull() {
    return hullOf(this.diagram, this.isGhost()).map((site) => this.positions[site]);
  }

  /** @param {Pair[]} edges @param {[number, number, number][]} triangles */
  urquhart(edges, triangles) {
    /** @param {number} a @param {number} b */
    const key = (a, b) => Math.min(a, b) * this.numPoints + Math.max(a, b);
    const number = new Map(edges.map(([a, b], i) => [key(a, b), i]));
    return (/** @type {import("../arguments.js").Numbers} */ given) => {
      const distances = numbersFor(given, edges.length, "distances", "edges");
      const isKept = edges.map(() => true);
      for (const [a, b, c] of triangles) {
        let [longest, length] = [-1, 0];
        for (const k of [key(a, b), key(b, c), key(c, a)]) {
          const i = number.get(k);
          if (i !== undefined && distances[i] > length) [longest, length] = [i, distances[i]];
        }
        if (longest >= 0) isKept[longest] = false;
      }
      return isKept;
    };
  }

  /** @param {number} lon @param {number} lat @param {number} next */
  find(lon, lat, next) {
    if (!Number.isFinite(number(lon, "lon") + number(lat, "lat"))) return next;
    const [site] = this.diagram.nearest(unitVectors(withinPoles(lon, lat)));
    return site === noIndex ? undefined : this.positions[site];
  }
}

/**
 * The Delaunay triangulation of points [longitude, latitude] in degrees, as of d3-geo-voronoi.
 * @param {any[]} points
 * @returns {GeoDelaunay}
 * @throws {import("../errors.js").RondelError} for the first point that is none
 */
export function geoDelaunay(points) {
  const lazy = new LazyDelaunay(points);
  /** @type {Record<string, () => unknown>} */
  const makers = {
    delaunay: () => lazy.delaunay(),
    edges: () => lazy.edges(),
    triangles: () => lazy.triangles(),
    centers: () => lazy.centers(),
    neighbors: () => lazy.neighbors(),
    polygons: () => lazy.polygons(),
    mesh: () => lazy.mesh(result.polygons),
    hull: () => lazy.hull(),
    isGhost: () => lazy.isGhost(),
    urquhart: () => lazy.urquhart(result.edges, result.triangles),
  };
  const result = /** @type {GeoDelaunay} */ ({
    find: (/** @type {number} */ lon, /** @type {number} */ lat, next = 0) => lazy.find(lon, lat, count(next, "next")),
  });
  for (const [name, make] of Object.entries(makers)) {
    Object.defineProperty(result, name, {
      configurable: true,
      enumerable: true,
      get() {
        const value = make();
        Object.defineProperty(result, name, { value, configurable: true, enumerable: true, writable: true });
        return value;
      },
    });
  }
  return result;
}
