// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The lines of one site's share of the picture, given one after the other to `arc(from, to)`.
//
// An edge belongs to its site of lower index, a border between two cells to the cell in whose ring it runs from the
// lower point to the higher one: so each is drawn once, by the same site while its surroundings stay as they are.

import { alongArc, angleBetween, cross, directionOf, perpendicular, plus, times, triple } from "./vectors.js";

// Chords of so many radians are within 4e-4 of their arcs: a fifth of a pixel on a large screen.
const longestChord = 0.055;

// An arc as chords, given to `chord(from, to)`.
export function inChords(a, b, chord) {
  const dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
  if (dx * dx + dy * dy + dz * dz < longestChord * longestChord) {
    chord(a, b);
    return;
  }
  const angle = angleBetween(a, b);
  const count = Math.ceil(angle / longestChord);
  let from = a;
  for (let i = 1; i <= count; ++i) {
    const to = i === count ? b : alongArc(a, b, angle, i / count);
    chord(from, to);
    from = to;
  }
}

// An edge between two ghost faces is not seen from the center.
export function edgesOf(surface, site, arc) {
  if (surface.dimension < 2) {
    ringEdgesOf(surface, site, arc);
    return;
  }
  for (let j = surface.starOffsets[site]; j < surface.starOffsets[site + 1]; ++j) {
    const face = surface.starFaces[j];
    let h = 3 * face;
    while (surface.faces[h] !== site) ++h;
    const i = h - 3 * face;
    const next = surface.faces[3 * face + ((i + 1) % 3)];
    if (next < site) continue;
    const across = surface.neighbors[3 * face + ((i + 2) % 3)];
    if (surface.isGhost[face] === 1 && surface.isGhost[across] === 1) continue;
    arc(surface.direction(site), surface.direction(next));
  }
}

// Sites on less than a half circle have one gap that is no edge: the shorter arc across it would run back
// over all others. Antipodal sites are joined by no shorter arc.
function ringEdgesOf(surface, site, arc) {
  surface.ringArcs ??= solidRingArcs(surface);
  for (const [from, to] of surface.ringArcs) {
    if (from === site) arc(surface.direction(from), surface.direction(to));
  }
}

function solidRingArcs(surface) {
  const ring = surface.ringOfVertices;
  const arcs = [];
  let sum = 0;
  let gap = 0;
  for (let i = 0; i < ring.length && ring.length > 1; ++i) {
    const from = ring[i];
    const to = ring[(i + 1) % ring.length];
    const angle = angleBetween(surface.direction(from), surface.direction(to));
    arcs.push([from, to, angle]);
    sum += angle;
    if (angle >= arcs[gap][2]) gap = i;
  }
  const rounding = 1e-9;
  const hasGap = arcs.length > 0 && (sum < 2 * Math.PI - rounding || arcs[gap][2] > Math.PI - rounding);
  if (hasGap) arcs.splice(gap, 1);
  return arcs.filter(([, , angle]) => angle < Math.PI - rounding);
}

export function bordersOf(surface, site, arc) {
  const begin = surface.ringOffsets[site];
  const end = surface.ringOffsets[site + 1];
  for (let j = begin; j < end; ++j) {
    const p = surface.ringPoints[j];
    const q = surface.ringPoints[j + 1 < end ? j + 1 : begin];
    if (isLower(surface.points, p, q)) arc(triple(surface.points, p), triple(surface.points, q));
  }
}

// In the order of x, then y, then z.
function isLower(points, p, q) {
  for (let k = 0; k < 3; ++k) {
    if (points[3 * p + k] !== points[3 * q + k]) return points[3 * p + k] < points[3 * q + k];
  }
  return false;
}

// The circle of radius `radius` around the unit vector `axis`.
export function circle(axis, radius, arc) {
  if (!(radius > 0)) return;
  const count = Math.min(128, Math.max(24, Math.ceil((2 * Math.PI * Math.sin(radius)) / longestChord)));
  const u = perpendicular(axis);
  const v = cross(axis, u);
  const at = (i) => {
    const angle = (2 * Math.PI * (i % count)) / count;
    const rim = plus(times(u, Math.cos(angle)), times(v, Math.sin(angle)));
    return plus(times(axis, Math.cos(radius)), times(rim, Math.sin(radius)));
  };
  for (let i = 0; i < count; ++i) arc(at(i), at(i + 1));
}

// Meridians up to 90 degrees less `step` (four of them to the poles) and parallels, as chords. Only what is
// within `reach` degrees of the middle, as everything else of a fine net would be far too much.
export function graticule(step, middle, reach, chord) {
  const [lon, lat] = middle;
  const low = Math.max(-90, Math.floor((lat - reach) / step) * step);
  const high = Math.min(90, Math.ceil((lat + reach) / step) * step);
  const widest = Math.max(Math.abs(low), Math.abs(high));
  const isAround = widest >= 90 - step || reach / Math.cos(widest * Math.PI / 180) >= 180;
  const across = isAround ? 180 : reach / Math.cos((widest * Math.PI) / 180);
  const west = Math.floor((lon - across) / step) * step;
  const piece = Math.min(step, 3);
  const columns = Math.min(Math.round(360 / step), Math.ceil((2 * across) / step) + 1);
  for (let i = 0; i < columns; ++i) {
    const meridian = west + i * step;
    const isMain = step >= 15 && Math.abs(Math.round(meridian / 90) * 90 - meridian) < 1e-9;
    const limit = isMain ? 90 : 90 - Math.min(step, 15);
    line(Math.max(low, -limit), Math.min(high, limit), piece, (t) => directionOf(meridian, t), chord);
  }
  for (let parallel = low; parallel <= high + step / 2; parallel += step) {
    if (Math.abs(parallel) < 90 - step / 2) {
      line(west, west + columns * step, piece, (t) => directionOf(t, parallel), chord);
    }
  }
}

function line(begin, end, piece, at, chord) {
  const count = Math.ceil((end - begin) / piece - 1e-9);
  for (let i = 0; i < count; ++i) {
    chord(at(begin + ((end - begin) * i) / count), at(begin + ((end - begin) * (i + 1)) / count));
  }
}
