// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sites in chunks along the spatial order, each with a cap that bounds all that is drawn of it. A frame
// looks at caps, and at sites only where a cap is in view.

import { none } from "./surface.js";

// Small chunks of few sites, so that lines and dots fit the places that they are in.
const fewest = 128;
const most = 1024;
const usualChunks = 64;

// Adds the largest distance of the rows of `points` that `indices` names from the center of the cap.
function widen(cap, points, indices, begin, end) {
  const [x, y, z] = cap.center;
  let most = cap.chord * cap.chord;
  for (let j = begin; j < end; ++j) {
    const i = 3 * indices[j];
    const square = (points[i] - x) ** 2 + (points[i + 1] - y) ** 2 + (points[i + 2] - z) ** 2;
    if (square > most) most = square;
  }
  cap.chord = Math.sqrt(most);
}

function middle(surface, begin, end) {
  const sum = [0, 0, 0];
  for (let j = begin; j < end; ++j) {
    for (let k = 0; k < 3; ++k) sum[k] += surface.directions[3 * surface.order[j] + k];
  }
  const length = Math.hypot(...sum);
  return length > 0 ? sum.map((x) => x / length) : [0, 0, 1];
}

// The geometric mean of the cells' areas, to which a few huge cells at the rim of a crowd mean little.
function typicalArea(surface, begin, end) {
  let sum = 0;
  let count = 0;
  for (let j = begin; j < end; ++j) {
    const area = surface.areas[surface.order[j]];
    if (!(area > 0)) continue;
    sum += Math.log(area);
    ++count;
  }
  return count > 0 ? Math.exp(sum / count) : 1;
}

// The sites order[begin] ... order[end - 1].
export function makeChunk(surface, radii, begin, end) {
  const chunk = { begin, end, center: middle(surface, begin, end), chord: 0, vertex: none };
  chunk.typicalArea = typicalArea(surface, begin, end);
  let widest = 0;
  for (let j = begin; j < end; ++j) {
    const site = surface.order[j];
    const from = surface.ringOffsets[site];
    const to = surface.ringOffsets[site + 1];
    widen(chunk, surface.points, surface.ringPoints, from, to);
    for (let k = surface.starOffsets[site]; k < surface.starOffsets[site + 1]; ++k) {
      const h = 3 * surface.starFaces[k];
      widen(chunk, surface.directions, surface.faces, h, h + 3);
    }
    if (chunk.vertex === none && !surface.isHidden(site)) chunk.vertex = site;
    if (radii !== null && radii[site] > widest) widest = radii[site];
  }
  widen(chunk, surface.directions, surface.order, begin, end);
  // Below dimension 2, and where a cell may be a hemisphere, arcs reach anywhere.
  if (surface.dimension < 2 || chunk.chord > 1.2) chunk.chord = 2;
  chunk.chord = Math.min(2, chunk.chord + widest);
  chunk.angle = 2 * Math.asin(chunk.chord / 2);
  return chunk;
}

// `radii`: those of the sites' circles in radians, or null.
export function makeChunks(surface, radii) {
  const chunks = [];
  const count = surface.order.length;
  const parts = Math.ceil(count / Math.min(most, Math.max(fewest, count / usualChunks)));
  for (let i = 0; i < parts; ++i) {
    chunks.push(makeChunk(surface, radii, Math.floor((i * count) / parts), Math.floor(((i + 1) * count) / parts)));
  }
  return chunks;
}

// Whether the cap of a chunk meets the cap that the camera sees.
export function isInView(chunk, camera) {
  const [x, y, z] = chunk.center;
  const [fx, fy, fz] = camera.forward;
  const chord = Math.hypot(x - fx, y - fy, z - fz);
  return 2 * Math.asin(Math.min(1, chord / 2)) <= chunk.angle + camera.reach;
}

// How far apart its sites are, in pixels.
export function spacing(chunk, camera) {
  return camera.zoom * Math.sqrt(chunk.typicalArea);
}
