// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Vectors of three doubles, as arrays [x, y, z], and places on the unit sphere.

export const degree = Math.PI / 180;

export function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function plus(a, b) {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function minus(a, b) {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function times(a, factor) {
  return [a[0] * factor, a[1] * factor, a[2] * factor];
}

export function lengthOf(a) {
  return Math.sqrt(dot(a, a));
}

// The unit vector of `a`; `a` itself if it is zero.
export function unit(a) {
  const length = lengthOf(a);
  return length > 0 ? times(a, 1 / length) : a;
}

// Row i of an array of triples.
export function triple(array, i) {
  return [array[3 * i], array[3 * i + 1], array[3 * i + 2]];
}

// The angle between unit vectors in radians, accurate for tiny ones too.
export function angleBetween(a, b) {
  return 2 * Math.atan2(lengthOf(minus(a, b)), lengthOf(plus(a, b)));
}

export function directionOf(lonDegrees, latDegrees) {
  const lon = lonDegrees * degree;
  const lat = latDegrees * degree;
  return [Math.cos(lat) * Math.cos(lon), Math.cos(lat) * Math.sin(lon), Math.sin(lat)];
}

// [longitude, latitude] in degrees.
export function lonLatOf(p) {
  return [Math.atan2(p[1], p[0]) / degree, Math.atan2(p[2], Math.hypot(p[0], p[1])) / degree];
}

// Any unit vector perpendicular to a unit vector.
export function perpendicular(p) {
  const axis = Math.abs(p[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  return unit(cross(axis, p));
}

// `p` turned around the unit vector `axis`, counterclockwise seen from its tip.
export function turned(p, axis, angle) {
  const c = Math.cos(angle);
  const versine = 2 * Math.sin(angle / 2) ** 2;
  return plus(plus(times(p, c), times(cross(axis, p), Math.sin(angle))), times(axis, dot(axis, p) * versine));
}

// The place at the fraction t of the shorter arc from a to b, which encloses `angle`.
export function alongArc(a, b, angle, t) {
  if (angle < 1e-6) return unit(plus(times(a, 1 - t), times(b, t)));
  return unit(plus(times(a, Math.sin((1 - t) * angle)), times(b, Math.sin(t * angle))));
}
