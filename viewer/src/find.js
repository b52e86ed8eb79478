// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which site is nearest to a place, and which face it is in: walks over the triangulation in doubles.
// Differences are taken before products, so that sites a millimetre apart are told apart.

import { none } from "./surface.js";

// Larger is nearer. Projected: less the squared chord. Weighted: the cosine of the Laguerre distance, less one.
function nearness(surface, site, q) {
  const p = surface.directions;
  const dx = p[3 * site] - q[0];
  const dy = p[3 * site + 1] - q[1];
  const dz = p[3 * site + 2] - q[2];
  const half = (dx * dx + dy * dy + dz * dz) / 2;
  if (surface.lengths === null) return -half;
  const length = surface.lengths[site];
  return length - 1 - length * half;
}

// Positive if q is to the left of the great circle from site a to site b.
function turnOf(surface, a, b, q) {
  const p = surface.directions;
  const ax = p[3 * a] - q[0], ay = p[3 * a + 1] - q[1], az = p[3 * a + 2] - q[2];
  const bx = p[3 * b] - q[0], by = p[3 * b + 1] - q[1], bz = p[3 * b + 2] - q[2];
  return q[0] * (ay * bz - az * by) + q[1] * (az * bx - ax * bz) + q[2] * (ax * by - ay * bx);
}

function holds(surface, face, q) {
  if (surface.isGhost[face] === 1) return false;
  const f = surface.faces;
  const h = 3 * face;
  return turnOf(surface, f[h], f[h + 1], q) >= 0 && turnOf(surface, f[h + 1], f[h + 2], q) >= 0 &&
    turnOf(surface, f[h + 2], f[h], q) >= 0;
}

export class Finder {
  constructor(surface, chunks) {
    this.surface = surface;
    this.chunks = chunks;
  }

  // The nearest vertex; of several the lowest index; `none` without sites. In a Delaunay or regular
  // triangulation a vertex that is nearer than all its neighbors is the nearest of all.
  nearest(q) {
    const { surface } = this;
    if (surface.dimension < 2) return this.nearestOf(surface.ringOfVertices, q, none);
    let best = this.start(q);
    for (;;) {
      const next = this.nearestOf(surface.neighborsOf(best), q, best);
      if (next === best) return best;
      best = next;
    }
  }

  nearestOf(sites, q, first) {
    let best = first;
    let most = first === none ? -Infinity : nearness(this.surface, first, q);
    for (const site of sites) {
      const value = nearness(this.surface, site, q);
      if (value > most || (value === most && site < best)) {
        best = site;
        most = value;
      }
    }
    return best;
  }

  // A vertex of the chunk in whose middle q is.
  start(q) {
    const { surface } = this;
    let start = none;
    let least = Infinity;
    for (const { center, vertex } of this.chunks) {
      const distance = (center[0] - q[0]) ** 2 + (center[1] - q[1]) ** 2 + (center[2] - q[2]) ** 2;
      if (distance < least && vertex !== none) {
        least = distance;
        start = vertex;
      }
    }
    return start === none ? surface.faces[0] : start;
  }

  // The solid face that holds q, of several the first; `none` outside of all. From a face at the nearest
  // vertex the walk crosses edges that have q on their other side; beyond ghost faces it may go astray, and
  // then all faces are asked.
  locate(q) {
    const { surface } = this;
    if (surface.dimension < 2) return none;
    let face = surface.starFaces[surface.starOffsets[this.nearest(q)]];
    for (let step = 0, from = none; step < 10_000; ++step) {
      if (holds(surface, face, q)) return this.firstOf(face, q);
      const next = this.across(face, from, q);
      if (next === none) break;
      from = face;
      face = next;
    }
    for (face = 0; face < surface.numFaces; ++face) {
      if (holds(surface, face, q)) return face;
    }
    return none;
  }

  across(face, from, q) {
    const { surface } = this;
    for (let i = 0; i < 3; ++i) {
      const next = surface.neighbors[3 * face + i];
      const a = surface.faces[3 * face + ((i + 1) % 3)];
      const b = surface.faces[3 * face + ((i + 2) % 3)];
      if (next !== from && turnOf(surface, a, b, q) < 0) return next;
    }
    return none;
  }

  // On an edge or a vertex several faces hold q.
  firstOf(face, q) {
    const { surface } = this;
    let first = face;
    for (const v of surface.corners(face)) {
      for (let j = surface.starOffsets[v]; j < surface.starOffsets[v + 1]; ++j) {
        const other = surface.starFaces[j];
        if (other < first && holds(surface, other, q)) first = other;
      }
    }
    return first;
  }
}
