// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// From where the globe is seen: orthographic, so that the unit sphere is a disc of `zoom` pixels radius.
//
// The frame (right, up, forward) is orthonormal; `forward` is the place in the middle of the picture. All of it
// is in doubles, so that a pixel of a hundredth of a millimetre on the earth is no problem.

import { cross, degree, directionOf, dot, lonLatOf, minus, plus, times, turned, unit } from "./vectors.js";

export const largestZoom = 1e12;

export class Camera {
  constructor() {
    this.width = 1;
    this.height = 1;
    this.zoom = 1;
    this.share = 0.44;  // of the picture's smaller side: the radius of the whole globe
    this.lookAt(0, 20, 0);
  }

  // `upDegrees`: the direction, clockwise from north, that points up.
  lookAt(lonDegrees, latDegrees, upDegrees) {
    this.face(directionOf(lonDegrees, latDegrees), upDegrees);
  }

  // The place `p` in the middle, with that direction up.
  face(p, upDegrees) {
    const [lon] = lonLatOf(p);
    const east = [-Math.sin(lon * degree), Math.cos(lon * degree), 0];
    this.forward = unit(p);
    this.right = turned(unit(minus(east, times(p, dot(east, p)))), this.forward, -upDegrees * degree);
    this.up = cross(this.forward, this.right);
  }

  // The direction that points up, in degrees clockwise from north.
  get bearing() {
    const [lon, lat] = lonLatOf(this.forward);
    const north = directionOf(lon + 180, 90 - lat);
    return Math.atan2(-dot(north, this.right), dot(north, this.up)) / degree;
  }

  resize(width, height) {
    const isFitting = Math.abs(this.zoom / this.fittingZoom - 1) < 1e-9 || this.width === 1;
    this.width = width;
    this.height = height;
    if (isFitting) this.zoom = this.fittingZoom;
  }

  // The whole globe with a margin.
  get fittingZoom() {
    return this.share * Math.min(this.width, this.height);
  }

  setZoom(zoom) {
    this.zoom = Math.min(largestZoom, Math.max(0.5 * this.fittingZoom, zoom));
  }

  // How far, in radians, what is on the screen may be from the middle.
  get reach() {
    const corner = Math.hypot(this.width, this.height) / 2 / this.zoom;
    return corner < 1 ? Math.asin(corner) : Math.PI / 2;
  }

  // The place at a pixel; beyond the limb null, or with `nearest` the place on the limb.
  placeAt(x, y, nearest = false) {
    let u = (x - this.width / 2) / this.zoom;
    let v = (this.height / 2 - y) / this.zoom;
    const square = u * u + v * v;
    if (square >= 1 && !nearest) return null;
    if (square >= 1) {
      u /= Math.sqrt(square) * (1 + 1e-12);
      v /= Math.sqrt(square) * (1 + 1e-12);
    }
    // forward * (sqrt(1 - s) - 1), without the loss of digits at small s
    const s = Math.min(1, u * u + v * v);
    const back = -s / (1 + Math.sqrt(1 - s));
    const offset = plus(plus(times(this.right, u), times(this.up, v)), times(this.forward, back));
    return unit(plus(this.forward, offset));
  }

  // {x, y, isFront}: the pixel of a place.
  pixelOf(p) {
    const d = minus(p, this.forward);
    return {
      x: this.width / 2 + this.zoom * dot(this.right, d),
      y: this.height / 2 - this.zoom * dot(this.up, d),
      isFront: 1 + dot(this.forward, d) > 0,
    };
  }

  // Turns the frame so that the place `from` comes to where `to` is.
  carry(from, to) {
    const axis = cross(from, minus(to, from));
    const sine = Math.hypot(...axis);
    if (sine === 0) return;
    const angle = Math.atan2(sine, dot(from, to));
    this.forward = unit(turned(this.forward, times(axis, 1 / sine), -angle));
    const right = turned(this.right, times(axis, 1 / sine), -angle);
    this.right = unit(minus(right, times(this.forward, dot(right, this.forward))));
    this.up = cross(this.forward, this.right);
  }

  roll(angleDegrees) {
    this.right = unit(turned(this.right, this.forward, -angleDegrees * degree));
    this.up = cross(this.forward, this.right);
  }

  // Brings the place `grabbed` under a pixel. Away from the poles the direction that points up stays.
  drag(grabbed, x, y) {
    const bearing = this.bearing;
    for (let step = 0; step < 8; ++step) {
      const { x: atX, y: atY } = this.pixelOf(grabbed);
      if (step > 0 && Math.hypot(atX - x, atY - y) < 1e-3) return;
      this.carry(grabbed, this.placeAt(x, y, true));
      const change = ((bearing - this.bearing + 540) % 360) - 180;
      if (Math.abs(this.forward[2]) < 0.98) this.roll(change);
    }
  }

  // Zooms by a factor; what is at the pixel stays there.
  zoomAt(factor, x, y) {
    const held = this.placeAt(x, y);
    this.setZoom(this.zoom * factor);
    if (held !== null && this.placeAt(x, y) !== null) this.drag(held, x, y);
  }

  // Moves the picture by pixels.
  pan(dx, dy) {
    const middle = this.placeAt(this.width / 2, this.height / 2);
    const limit = 0.9 * this.zoom;
    const step = Math.min(1, limit / Math.max(1e-300, Math.hypot(dx, dy)));
    this.drag(middle, this.width / 2 + step * dx, this.height / 2 + step * dy);
  }
}
