// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The earth behind the sites: coasts as lines, land as a picture of the plane of longitude and latitude.
//
// data/coast.txt: a line is a closed coast; longitude and latitude of its first point in hundredths of a degree,
// then the steps from point to point. Longitudes go on beyond 180 degrees.

import { directionOf } from "./vectors.js";

const landWidth = 4096;

// Rings of [longitude, latitude] in degrees; the last point of a ring is the first one, or a turn away from it.
export function readCoast(bytes) {
  return new TextDecoder().decode(bytes).trim().split("\n").map((line) => {
    const numbers = line.split(" ").map(Number);
    const ring = [];
    let lon = 0;
    let lat = 0;
    for (let i = 0; i < numbers.length; i += 2) {
      lon += numbers[i];
      lat += numbers[i + 1];
      ring.push([lon / 100, lat / 100]);
    }
    return ring;
  });
}

export function coastChords(rings, chord) {
  for (const ring of rings) {
    const points = ring.map(([lon, lat]) => directionOf(lon, lat));
    for (let i = 1; i < points.length; ++i) chord(points[i - 1], points[i]);
  }
}

// A canvas, white where there is land. Longitudes from -180 to 180 grow to the right, latitudes upwards.
export function drawLand(rings) {
  const canvas = document.createElement("canvas");
  canvas.width = landWidth;
  canvas.height = landWidth / 2;
  const pen = canvas.getContext("2d", { willReadFrequently: true });
  pen.fillStyle = "#000";
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.fillStyle = "#fff";
  const scale = landWidth / 360;
  for (const ring of rings) {
    const path = aroundPole(ring);
    pen.beginPath();
    for (const turn of [-360, 0, 360]) {
      path.forEach(([lon, lat], i) => {
        const [x, y] = [(lon + turn + 180) * scale, (90 - lat) * scale];
        if (i === 0) pen.moveTo(x, y);
        else pen.lineTo(x, y);
      });
      pen.closePath();
    }
    pen.fill("evenodd");
  }
  return canvas;
}

// A coast that ends a turn away from where it began surrounds a pole: the way there closes it.
function aroundPole(ring) {
  const [first, last] = [ring[0], ring[ring.length - 1]];
  if (Math.abs(last[0] - first[0]) < 180) return ring;
  const pole = first[1] < 0 ? -90 : 90;
  return [...ring, [last[0], pole], [first[0], pole]];
}
