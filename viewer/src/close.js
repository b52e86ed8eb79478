// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Drawing near the ground: where the sites of a chunk are much farther apart than the screen is wide, 32 bits are
// not enough. Lines and cells are then cut in doubles at a frame around the screen, and what is left is sent in
// pixels from its middle.

import { inChords } from "./arcs.js";
import { cross, dot, lengthOf, minus, times, unit } from "./vectors.js";

// The frame is so many screens wide.
const screens = 3;

export class Close {
  constructor(camera) {
    this.camera = camera;
    this.halfWidth = (screens * camera.width) / 2;
    this.halfHeight = (screens * camera.height) / 2;
    this.segments = [];
    this.corners = [];
    this.indices = [];
    this.sites = [];
    this.chord = (a, b) => this.cutChord(this.flat(a), this.flat(b));
    this.arc = (a, b) => inChords(a, b, this.chord);
  }

  // Pixels from the middle, and the depth.
  flat(p) {
    const { right, up, forward, zoom } = this.camera;
    const d = minus(p, forward);
    return [zoom * dot(right, d), zoom * dot(up, d), 1 + dot(forward, d)];
  }

  // The part of a chord in front and in the frame, by the parameters at which it enters and leaves.
  cutChord(a, b) {
    let begin = 0;
    let end = 1;
    const walls = [
      [a[2], b[2]],
      [a[0] + this.halfWidth, b[0] + this.halfWidth],
      [this.halfWidth - a[0], this.halfWidth - b[0]],
      [a[1] + this.halfHeight, b[1] + this.halfHeight],
      [this.halfHeight - a[1], this.halfHeight - b[1]],
    ];
    for (const [atA, atB] of walls) {
      if (atA < 0 && atB < 0) return;
      if (atA < 0) begin = Math.max(begin, atA / (atA - atB));
      else if (atB < 0) end = Math.min(end, atA / (atA - atB));
    }
    if (begin >= end) return;
    const at = (t) => [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), 0];
    this.segments.push(...at(begin), ...at(end));
  }

  // A cell is what is to the left of all its sides: the frame is cut by one after the other. The distance from a
  // side is taken from one of its ends, so that it is right for short sides too.
  cell(ring, level) {
    const { right, up, forward, zoom } = this.camera;
    const [w, h] = [this.halfWidth, this.halfHeight];
    let region = [[-w, -h], [w, -h], [w, h], [-w, h]];
    ring.forEach((p, i) => {
      const side = minus(ring[(i + 1) % ring.length], p);
      const normal = cross(p, side);
      if (lengthOf(normal) === 0 || region.length === 0) return;
      const n = unit(normal);
      const offset = zoom * dot(n, minus(forward, p));
      const [nx, ny] = [dot(n, right), dot(n, up)];
      region = cutRegion(region, (q) => offset + nx * q[0] + ny * q[1]);
    });
    const first = this.corners.length / 4;
    for (const [x, y] of region) this.corners.push(x, y, 0, level);
    for (let i = 2; i < region.length; ++i) this.indices.push(first, first + i - 1, first + i);
  }

  site(p, level) {
    const [x, y, depth] = this.flat(p);
    if (depth > 0 && Math.abs(x) < this.halfWidth && Math.abs(y) < this.halfHeight) this.sites.push(x, y, 0, level);
  }
}

// The part of a convex polygon where `height` is not negative.
function cutRegion(region, height) {
  const result = [];
  region.forEach((q, i) => {
    const next = region[(i + 1) % region.length];
    const here = height(q);
    const there = height(next);
    if (here >= 0) result.push(q);
    if ((here < 0 && there > 0) || (here > 0 && there < 0)) {
      const t = here / (here - there);
      result.push([q[0] + t * (next[0] - q[0]), q[1] + t * (next[1] - q[1])]);
    }
  });
  return result;
}

// The border of a region without lines inside it, for what is chosen.
export function outline(close, corners) {
  corners.forEach((p, i) => close.arc(p, corners[(i + 1) % corners.length]));
}

// A little circle of `pixels` around a place, at any zoom.
export function mark(close, p, pixels) {
  const [x, y, depth] = close.flat(p);
  if (depth < 0 || Math.abs(x) > close.halfWidth || Math.abs(y) > close.halfHeight) return;
  const count = 32;
  const at = (i) => times([Math.cos((2 * Math.PI * i) / count), Math.sin((2 * Math.PI * i) / count), 0], pixels);
  for (let i = 0; i < count; ++i) {
    const [a, b] = [at(i), at(i + 1)];
    close.segments.push(x + a[0], y + a[1], 0, x + b[0], y + b[1], 0);
  }
}
