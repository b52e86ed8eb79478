// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// geoDelaunay() of d3-geo-voronoi 2.1, with properties that are made when they are first read.

import { noIndex, unitVectors, voronoi } from "../triangulation.js";
import { planarView } from "./planar.js";
import { cross, dot, toLonLat, withinPoles } from "./sphere.js";

/** @typedef {import("./sphere.js").LonLat} LonLat */
/** @typedef {import("./sphere.js").Vector} Vector */
/** @typedef {[number, number]} Pair */

/**
 * What geoDelaunay() returns. All arrays hold positions in the array of points; those that are not finite belong to nothing.
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
 * @property {(distances: ArrayLike<number>) => boolean[]} urquhart which edges are in the Urquhart graph
 * @property {(lon: number, lat: number, next?: number) => number} find the nearest point
 */

// Arcs that lack less than 1.4 mrad to half a circle keep a point in between: which way they go would drown in rounding.
const leastCosine = -1 + 1e-6;

/** The positions of the points that are finite. @param {ArrayLike<number>[]} points */
function finitePositions(points) {
  const positions = [];
  for (let i = 0; i < points.length; ++i) if (Number.isFinite(points[i][0] + points[i][1])) positions.push(i);
  return positions;
}

/** @param {number} h the halfedge, or corner, of the same face that follows */
const following = (h) => (h % 3 === 2 ? h - 2 : h + 1);

// Of sites on one side of a hull, say those on a meridian, rounding moves some inside, by less than this, in radians.
const flat = 1e-14;

/** Which of its edges a face is as flat as, as the corner opposite to the longest; none if it is not flat.
 * @param {import("../triangulation.js").VoronoiDiagram} diagram
 * @param {number} face */
function flatCorner({ triangles, points }, face) {
  /** @type {Vector[]} */
  const p = [0, 1, 2].map((i) => {
    const at = 3 * triangles[3 * face + i];
    return [points[at], points[at + 1], points[at + 2]];
  });
  /** @param {Vector} a @param {Vector} b @returns {Vector} */
  const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const lengths = [0, 1, 2].map((i) => Math.hypot(...minus(p[(i + 1) % 3], p[(i + 2) % 3])));
  const longest = lengths.indexOf(Math.max(...lengths));
  const volume = dot(p[0], cross(minus(p[1], p[0]), minus(p[2], p[0])));
  return volume <= flat * lengths[longest] ? 3 * face + longest : -1;
}

/**
 * The ghost faces, and from them on inwards the faces that are flat.
 * @param {import("../triangulation.js").VoronoiDiagram} diagram
 * @param {Uint8Array} isGhost
 */
function outsideOfHull(diagram, isGhost) {
  const { neighbors } = diagram;
  const isOutside = isGhost.slice();
  const waiting = Array.from(diagram.ghostFaces);
  for (let face = waiting.pop(); face !== undefined; face = waiting.pop()) {
    for (let h = 3 * face; h < 3 * face + 3; ++h) {
      const across = neighbors[h];
      if (isOutside[across]) continue;
      const corner = flatCorner(diagram, across);
      if (corner < 0 || neighbors[corner] !== face) continue;
      isOutside[across] = 1;
      waiting.push(across);
    }
  }
  return isOutside;
}

class LazyDelaunay {
  /** @param {any[]} points */
  constructor(points) {
    this.points = points;
    /** Position of a site in `points`. */
    this.positions = finitePositions(points);
    const { positions } = this;
    const lonLat = new Float64Array(2 * positions.length);
    positions.forEach((p, i) => lonLat.set(withinPoles(+points[p][0], +points[p][1]), 2 * i));
    this.diagram = voronoi.lonLat(lonLat);
    this.isWhole = positions.length === points.length;
  }

  /** @param {Uint32Array} sites */
  toPositions(sites) {
    return this.isWhole ? sites : sites.map((site) => this.positions[site]);
  }

  /** The triangulation as planar code wants it. */
  delaunay() {
    const { triangles, neighbors } = this.diagram;
    const places = this.positions.map((p) => /** @type {LonLat} */ (withinPoles(+this.points[p][0], +this.points[p][1])));
    const view = /** @type {any} */ (planarView(places, triangles, neighbors));
    return view.triangles ? { ...view, triangles: this.toPositions(triangles) } : view;
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

  /** Of a great circle: the pairs of neighbors around it. */
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
    const result = this.points.map(() => []);
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
    const result = new Array(this.points.length).fill(undefined);
    for (let site = 0; site < this.positions.length; ++site) {
      const [begin, end] = [offsets[site], offsets[site + 1]];
      if (begin === end) continue;
      const ring = [];
      let numCenters = 0;
      for (let i = begin; i < end; ++i) if (rings[i] < numFaces) ++numCenters;
      for (let i = end - 1; i >= begin; --i) {
        const before = rings[i === begin ? end - 1 : i - 1];
        const after = rings[i + 1 === end ? begin : i + 1];
        // The library bends arcs of more than 120 degrees; d3-geo wants points where they are needed only.
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

  /** The edges between what is outside of the hull and what is not, one after the other. */
  hull() {
    const { neighbors } = this.diagram;
    const isOutside = outsideOfHull(this.diagram, this.isGhost());
    const corners = this.corners();
    const next = new Map();
    for (let h = 0; h < corners.length; ++h) {
      if (!isOutside[Math.floor(h / 3)] || isOutside[neighbors[h]]) continue;
      next.set(corners[following(h)], corners[following(following(h))]);
    }
    /** @type {number[]} */
    const result = [];
    if (next.size === 0) return result;
    const first = [...next.keys()].reduce((a, b) => Math.min(a, b));
    let corner = first;
    do {
      result.push(corner);
      corner = next.get(corner);
    } while (corner !== first && result.length < next.size);
    return result;
  }

  /** @param {Pair[]} edges @param {[number, number, number][]} triangles */
  urquhart(edges, triangles) {
    /** @param {number} a @param {number} b */
    const key = (a, b) => Math.min(a, b) * this.points.length + Math.max(a, b);
    const number = new Map(edges.map(([a, b], i) => [key(a, b), i]));
    return (/** @type {ArrayLike<number>} */ distances) => {
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
    if (!Number.isFinite(lon + lat)) return next;
    const [site] = this.diagram.nearest(unitVectors(withinPoles(lon, lat)));
    return site === noIndex ? next : this.positions[site];
  }
}

/**
 * The Delaunay triangulation of points [longitude, latitude] in degrees, as of d3-geo-voronoi.
 * @param {any[]} points
 * @returns {GeoDelaunay}
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
    find: (/** @type {number} */ lon, /** @type {number} */ lat, next = 0) => lazy.find(lon, lat, next),
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
