// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the graphics processor draws of a chunk: 32-bit offsets from the middle of its cap.

import { bordersOf, edgesOf, inChords } from "./arcs.js";
import { cross, dot, lengthOf, minus, plus, times, unit } from "./vectors.js";

// Numbers that grow.
class Numbers {
  constructor(Kind) {
    this.values = new Kind(1024);
    this.length = 0;
  }

  push(...more) {
    if (this.length + more.length > this.values.length) {
      const larger = new this.values.constructor(2 * this.values.length);
      larger.set(this.values);
      this.values = larger;
    }
    for (const value of more) this.values[this.length++] = value;
  }

  get used() {
    return this.values.subarray(0, this.length);
  }
}

export class Segments {
  constructor(center) {
    this.center = center;
    this.numbers = new Numbers(Float32Array);
    this.chord = (a, b) => {
      const [x, y, z] = this.center;
      this.numbers.push(a[0] - x, a[1] - y, a[2] - z, b[0] - x, b[1] - y, b[2] - z);
    };
    this.arc = (a, b) => inChords(a, b, this.chord);
  }

  get data() {
    return this.numbers.used;
  }

  get count() {
    return this.numbers.length / 6;
  }
}

// Where a fan of triangles over a convex region may start: the mean of its corners, or for a hemisphere the
// direction of the area that its boundary encloses.
export function middleOf(corners) {
  const mean = times(corners.reduce(plus), 1 / corners.length);
  if (lengthOf(mean) > 0.1) return unit(mean);
  return unit(corners.map((p, i) => cross(p, corners[(i + 1) % corners.length])).reduce(plus));
}

// Triangles of cells. A large cell is a fan in several rings, so that it is as round as the sphere; the rim has the
// same points as its neighbors', so that there are no cracks.
export class Fans {
  constructor(center) {
    this.center = center;
    this.corners = new Numbers(Float32Array);
    this.indices = new Numbers(Uint32Array);
  }

  add(p, level) {
    const [x, y, z] = this.center;
    this.corners.push(p[0] - x, p[1] - y, p[2] - z, level);
    return this.corners.length / 4 - 1;
  }

  cell(ring, level) {
    const middle = middleOf(ring);
    const rim = [];
    ring.forEach((p, i) => inChords(p, ring[(i + 1) % ring.length], (from) => rim.push(from)));
    const least = rim.reduce((cosine, p) => Math.min(cosine, dot(p, middle)), 1);
    const rings = Math.max(1, Math.ceil(Math.acos(Math.max(-1, least)) / 0.06));
    const hub = this.add(middle, level);
    let inner = null;
    for (let k = 1; k <= rings; ++k) {
      const outer = rim.map((p) => this.add(
        k === rings ? p : unit(plus(middle, times(minus(p, middle), k / rings))), level));
      outer.forEach((corner, i) => {
        const next = outer[(i + 1) % outer.length];
        if (inner === null) {
          this.indices.push(hub, corner, next);
        } else {
          const [a, b] = [inner[i], inner[(i + 1) % inner.length]];
          this.indices.push(a, corner, next, a, next, b);
        }
      });
      inner = outer;
    }
  }
}

// The layers that can be asked of a chunk.
export const makers = {
  edges(chunk, { surface }) {
    const segments = new Segments(chunk.center);
    for (let j = chunk.begin; j < chunk.end; ++j) edgesOf(surface, surface.order[j], segments.arc);
    return segments;
  },
  borders(chunk, { surface }) {
    const segments = new Segments(chunk.center);
    for (let j = chunk.begin; j < chunk.end; ++j) bordersOf(surface, surface.order[j], segments.arc);
    return segments;
  },
  circles(chunk, { surface, circlesOf }) {
    const segments = new Segments(chunk.center);
    for (let j = chunk.begin; j < chunk.end; ++j) circlesOf(surface.order[j], segments.arc);
    return segments;
  },
  cells(chunk, { surface, levelOf }) {
    const fans = new Fans(chunk.center);
    for (let j = chunk.begin; j < chunk.end; ++j) {
      const ring = surface.ring(surface.order[j]);
      if (ring.length > 0) fans.cell(ring, levelOf(surface.order[j]));
    }
    return fans;
  },
};

// About how many vertices a site costs in each layer.
export const costs = { edges: 12, borders: 12, cells: 18, circles: 4 * 24 };
