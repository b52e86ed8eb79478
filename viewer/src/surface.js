// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The triangulation and its cells as the screen needs them, made from the faces alone.
//
// 1. Star of a vertex: its faces, counterclockwise, starFaces[starOffsets[v]] ... ; empty for other sites. The corner
//    after v in each, its neighbors: starSites.
// 2. neighbors[3 f + i] is the face across the edge of face f that is opposite to corner i.
// 3. Ring of a cell: positions in `points`, counterclockwise. Position f is the circumcenter of face f.
// 4. `order` has all vertices and hidden sites, those that are close in space close to each other: faces
//    come in the spatial order of their first corners. Who keeps the sites in an order of its own may set it.

import { triple, dot, minus, cross } from "./vectors.js";

export const none = 0xffffffff;

// What the circumcenter of a face comes to in plain doubles. The writer does the same operations in the same
// order and stores how the bits of the right one differ.
function plainCenter(p, corners, f, out) {
  const a = 3 * corners[3 * f];
  const b = 3 * corners[3 * f + 1];
  const c = 3 * corners[3 * f + 2];
  const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
  const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
  const x = uy * vz - uz * vy;
  const y = uz * vx - ux * vz;
  const z = ux * vy - uy * vx;
  const length = Math.sqrt(x * x + y * y + z * z);
  if (!(length > 0 && length < Infinity)) return;
  out[3 * f] = x / length;
  out[3 * f + 1] = y / length;
  out[3 * f + 2] = z / length;
}

function restoredPoints(directions, faces, lengths, stored) {
  const scaled = lengths ? directions.map((x, i) => x * lengths[Math.floor(i / 3)]) : directions;
  const points = new Float64Array(stored.length);
  for (let f = 0; f < faces.length / 3; ++f) plainCenter(scaled, faces, f, points);
  const bits = new Uint32Array(points.buffer);
  const differences = new Uint32Array(stored.buffer);
  for (let i = 0; i < bits.length; ++i) bits[i] ^= differences[i];
  return points;
}

function offsetsOf(counts) {
  const offsets = new Uint32Array(counts.length + 1);
  for (let i = 0; i < counts.length; ++i) offsets[i + 1] = offsets[i] + counts[i];
  return offsets;
}

// Faces around each vertex with the corner that follows it in each, and neighbors: the face after f around v starts
// with the edge at which f ends.
function linkStars(numSites, faces) {
  const counts = new Uint32Array(numSites);
  for (const v of faces) ++counts[v];
  const starOffsets = offsetsOf(counts);
  const unsorted = new Uint32Array(faces.length);
  const ends = starOffsets.slice(0, numSites);
  for (let h = 0; h < faces.length; ++h) unsorted[ends[faces[h]]++] = h;

  const starFaces = new Uint32Array(faces.length);
  const starSites = new Uint32Array(faces.length);
  const neighbors = new Uint32Array(faces.length);
  const leavingTo = new Uint32Array(numSites);  // halfedge index of v in the face whose next corner it is
  const corner = (h, step) => h - (h % 3) + (((h % 3) + step) % 3);
  for (let v = 0; v < numSites; ++v) {
    const begin = starOffsets[v];
    const end = starOffsets[v + 1];
    for (let j = begin; j < end; ++j) leavingTo[faces[corner(unsorted[j], 1)]] = unsorted[j];
    for (let j = begin, h = unsorted[begin]; j < end; ++j) {
      starFaces[j] = Math.floor(h / 3);
      starSites[j] = faces[corner(h, 1)];
      const next = leavingTo[faces[corner(h, 2)]];
      neighbors[corner(h, 1)] = Math.floor(next / 3);
      h = next;
    }
  }
  return { starOffsets, starFaces, starSites, neighbors };
}

function spatialOrder(surface, ring, hidden) {
  const { numSites, faces } = surface;
  const isListed = new Uint8Array(numSites);
  const belowFace = new Map();
  for (let i = 0; i < hidden.length; i += 2) {
    if (!belowFace.has(hidden[i + 1])) belowFace.set(hidden[i + 1], []);
    belowFace.get(hidden[i + 1]).push(hidden[i]);
  }
  const order = [];
  const list = (v) => {
    if (isListed[v] === 0) order.push(v);
    isListed[v] = 1;
  };
  for (let h = 0; h < faces.length; ++h) {
    list(faces[h]);
    if (h % 3 === 2 && hidden.length > 0) (belowFace.get((h - 2) / 3) ?? []).forEach(list);
  }
  ring.forEach(list);
  (belowFace.get(none) ?? []).forEach(list);
  return Uint32Array.from(order);
}

export class Surface {
  #order = null;

  constructor(about, arrays) {
    this.dimension = about.dimension;
    this.isWeighted = about.model === "weighted";
    this.numSites = about.sites;
    this.directions = arrays.directions;
    this.lengths = arrays.lengths ?? null;
    this.faces = arrays.faces;
    this.numFaces = this.faces.length / 3;
    this.areas = arrays.areas;
    this.ringOfVertices = arrays.ring ?? new Uint32Array(0);
    Object.assign(this, linkStars(this.numSites, this.faces));
    this.points = arrays.exactPoints ?? restoredPoints(this.directions, this.faces, this.lengths, arrays.points);
    this.ringOffsets = arrays.ringOffsets ?? this.starOffsets;
    this.ringPoints = arrays.ringPoints ?? this.starFaces;
    this.isGhost = new Uint8Array(this.numFaces);
    for (const f of arrays.ghosts ?? []) this.isGhost[f] = 1;
    this.keepSites(arrays.duplicates ?? [], arrays.hidden ?? []);
  }

  keepSites(duplicates, hidden) {
    this.representative = new Map();
    for (let i = 0; i < duplicates.length; i += 2) this.representative.set(duplicates[i], duplicates[i + 1]);
    this.faceAbove = new Map();
    for (let i = 0; i < hidden.length; i += 2) this.faceAbove.set(hidden[i], hidden[i + 1]);
    this.hiddenSites = hidden;
  }

  get order() {
    this.#order ??= spatialOrder(this, this.ringOfVertices, this.hiddenSites);
    return this.#order;
  }

  set order(sites) {
    this.#order = sites;
  }

  isHidden(site) {
    return this.faceAbove.has(site);
  }

  direction(site) {
    return triple(this.directions, site);
  }

  corners(face) {
    return triple(this.faces, face);
  }

  // The corners of a cell's ring as points.
  ring(site) {
    const result = [];
    for (let j = this.ringOffsets[site]; j < this.ringOffsets[site + 1]; ++j) {
      result.push(triple(this.points, this.ringPoints[j]));
    }
    return result;
  }

  // The vertices that share an edge with a site, counterclockwise.
  neighborsOf(site) {
    if (this.dimension < 2) return this.neighborsOnRing(site);
    return Array.from(this.starSites.subarray(this.starOffsets[site], this.starOffsets[site + 1]));
  }

  neighborsOnRing(site) {
    const ring = this.ringOfVertices;
    const i = ring.indexOf(site);
    if (i < 0 || ring.length < 2) return [];
    return [...new Set([ring[(i + ring.length - 1) % ring.length], ring[(i + 1) % ring.length]])];
  }

  // The area of a face seen from the center, in steradians (Van Oosterom and Strackee 1983).
  faceArea(face) {
    const [a, b, c] = this.corners(face).map((v) => this.direction(v));
    const volume = dot(a, cross(minus(b, a), minus(c, a)));
    return 2 * Math.atan2(volume, 1 + dot(a, b) + dot(b, c) + dot(c, a));
  }
}
