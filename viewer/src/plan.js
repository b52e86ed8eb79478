// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a frame shows of each chunk, within a bound on its vertices:
//   full    its lines and cells, from buffers that are made when they are first wanted;
//   close   the same, cut in doubles at the screen, where the chunk is far wider than that;
//   coarse  its sites as points, where they are so close that lines would cover everything, or where the frame
//           would have too many vertices.

import { isInView, spacing } from "./chunks.js";
import { costs } from "./shapes.js";

export const mostVertices = 2_000_000;
export const mostFull = 1_200_000;
export const mostCoarse = 700_000;

const leastSpacing = 3;  // pixels between sites whose lines are drawn, unless all are few
const fewVertices = 300_000;
const farthestClose = 200;  // a chunk so many times wider than the screen is drawn close

// The vertices of a chunk with all that is wanted of it: those of its buffers, or about so many.
export function costOf(chunk, wanted) {
  const count = chunk.end - chunk.begin;
  const part = (name) => chunk.parts?.[name]?.numVertices ?? costs[name] * count;
  return wanted.reduce((sum, name) => sum + part(name), count);
}

// [{chunk, way, spacing}] of all chunks in view; `wanted` are the names of layers.
export function planViews(chunks, camera, wanted) {
  const views = [];
  let total = 0;
  for (const chunk of chunks) {
    if (!isInView(chunk, camera)) continue;
    const cost = costOf(chunk, wanted);
    views.push({ chunk, way: "coarse", spacing: spacing(chunk, camera), cost });
    total += cost;
  }
  const least = total <= fewVertices ? 0 : leastSpacing;
  const screen = Math.hypot(camera.width, camera.height);
  let left = mostFull;
  for (const view of [...views].sort((a, b) => b.spacing - a.spacing)) {
    if (view.spacing < least || view.cost > left) continue;
    left -= view.cost;
    const isFar = camera.zoom > 2000 && view.chunk.chord * camera.zoom > farthestClose * screen;
    view.way = isFar ? "close" : "full";
  }
  return views;
}
