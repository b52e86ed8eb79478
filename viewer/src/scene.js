// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// One frame: the parts of the picture, in the order in which they cover each other, and the buffers behind them.

import { edgesOf, bordersOf, circle } from "./arcs.js";
import { Close, mark, outline } from "./close.js";
import { Lines, widestLine } from "./lines.js";
import { costOf, mostCoarse, mostFull, mostVertices, planViews } from "./plan.js";
import { makers, Segments } from "./shapes.js";

const mostKept = 8_000_000;  // vertices in buffers
const patience = 24;  // milliseconds a frame may spend on new buffers

export class Scene {
  constructor(canvas, camera, surface, chunks, layers, radii, lines) {
    Object.assign(this, { canvas, camera, surface, chunks, layers, radii });
    this.circlesOf = radii && ((site, arc) => circle(this.surface.direction(site), this.radii[site], arc));
    this.chosen = [];  // rings of places to outline, and places to mark
    this.pointed = [];
    this.circled = [];  // circles: {axis, radius}
    this.isSettled = false;
    this.keepSites();
    this.lines = new Lines(canvas, camera, layers, lines, this);
  }

  // The prefix of a chunk's points is a fair sample of it: they are stored by steps that leave no part out.
  keepSites() {
    const data = new Float32Array(4 * this.surface.order.length);
    for (const { begin, end, center } of this.chunks) {
      const count = end - begin;
      let step = Math.max(1, Math.round(count * 0.6180339887));
      while (greatestDivisor(step, count) > 1) ++step;
      for (let i = 0, at = 0; i < count; ++i, at = (at + step) % count) {
        const site = this.surface.order[begin + at];
        for (let k = 0; k < 3; ++k) data[4 * (begin + i) + k] = this.surface.directions[3 * site + k] - center[k];
        data[4 * (begin + i) + 3] = this.layers.levelOf(site);
      }
    }
    this.sitesBuffer = this.canvas.refill(this.sitesBuffer ?? this.canvas.gl.createBuffer(), data);
  }

  // Makes again what was in a context that was lost.
  restore() {
    for (const chunk of this.chunks) delete chunk.parts;
    this.sitesBuffer = undefined;
    this.keepSites();
    this.lines.keep();
  }

  // After a change of the values: colors are part of the buffers.
  recolor() {
    for (const chunk of this.chunks) this.drop(chunk, ["cells"]);
    this.keepSites();
  }

  drop(chunk, names) {
    for (const name of names) {
      const part = chunk.parts?.[name];
      if (part === undefined) continue;
      for (const buffer of part.buffers) this.canvas.gl.deleteBuffer(buffer);
      delete chunk.parts[name];
    }
  }

  get wanted() {
    const names = [];
    if (this.layers.isFilled) names.push("cells");
    if (this.layers.borders) names.push("borders");
    if (this.layers.edges) names.push("edges");
    if (this.layers.circles && this.circlesOf !== null) names.push("circles");
    return names;
  }

  // Other sites in other chunks: those that bring their buffers along keep them.
  update(surface, chunks, radii) {
    const kept = new Set(chunks.map((chunk) => chunk.parts));
    for (const chunk of this.chunks) {
      if (!kept.has(chunk.parts)) this.drop(chunk, Object.keys(chunk.parts ?? {}));
    }
    Object.assign(this, { surface, chunks, radii });
    this.keepSites();
  }

  // The buffers of a chunk; null where there is no time left in this frame, unless the chunk is urgent.
  part(chunk, name) {
    chunk.parts ??= {};
    if (chunk.parts[name] === undefined) {
      if (performance.now() > this.deadline && !chunk.isUrgent) return null;
      const context = { surface: this.surface, circlesOf: this.circlesOf, levelOf: (site) => this.layers.levelOf(site) };
      const shape = makers[name](chunk, context);
      const { gl } = this.canvas;
      chunk.parts[name] = shape instanceof Segments
        ? { buffers: [this.canvas.keep(shape.data)], count: shape.count, numVertices: 4 * shape.count }
        : { buffers: [this.canvas.keep(shape.corners.used), this.canvas.keep(shape.indices.used, gl.ELEMENT_ARRAY_BUFFER)],
          count: shape.indices.length, numVertices: shape.indices.length };
    }
    return chunk.parts[name];
  }

  // Buffers of chunks that are not drawn, where all of them hold too much.
  forget(views) {
    const kept = (chunk) => Object.values(chunk.parts ?? {}).reduce((sum, part) => sum + part.numVertices, 0);
    let total = this.chunks.reduce((sum, chunk) => sum + kept(chunk), 0);
    if (total < mostKept) return;
    const inUse = new Set(views.filter((view) => view.way === "full").map((view) => view.chunk));
    for (const chunk of this.chunks) {
      if (total < mostKept) return;
      if (inUse.has(chunk)) continue;
      total -= kept(chunk);
      this.drop(chunk, Object.keys(chunk.parts ?? {}));
    }
  }

  draw(theme, scale) {
    const { canvas, camera, layers } = this;
    this.deadline = performance.now() + patience;
    const views = planViews(this.chunks, camera, this.wanted);
    this.make(views);
    const ways = { full: [], close: [], coarse: [] };
    for (const view of views) ways[view.way].push(view);
    const close = this.cut(ways.close);

    canvas.begin(camera, scale);
    canvas.drawGlobe(theme, layers.coast ? 1 : 0);
    if (layers.isFilled) {
      this.drawCells(ways.full, close.cells, theme);
      this.drawCoarse(ways.coarse, theme);
    }
    this.lines.draw(theme);
    for (const name of this.wanted.filter((wanted) => wanted !== "cells")) {
      const paint = { edges: theme.edge, borders: theme.border, circles: theme.circle }[name];
      this.drawLines(name, ways.full, close[name], paint, layers.isFilled ? 0.8 : 1);
    }
    if (!layers.isFilled) this.drawCoarse(ways.coarse, theme);
    if (layers.sites) this.drawSites(ways.full, close.sites, theme);
    this.drawChosen(theme);
    this.forget(views);
    this.statistics = {
      vertices: canvas.numVertices, mostVertices, chunks: views.length,
      full: ways.full.length, close: ways.close.length, coarse: ways.coarse.length,
    };
  }

  // Makes the buffers that this frame wants, as many as its time allows. Chunks without all of theirs are drawn as
  // points until then, and those that turn out to be larger than was planned for stay points.
  make(views) {
    this.isSettled = true;
    let left = mostFull;
    for (const view of views) {
      if (view.way !== "full") continue;
      if (this.wanted.some((name) => this.part(view.chunk, name) === null)) {
        view.way = "coarse";
        this.isSettled = false;
        continue;
      }
      left -= costOf(view.chunk, this.wanted);
      if (left < 0) view.way = "coarse";
    }
  }

  // What is drawn close: one `Close` for each layer.
  cut(views) {
    const parts = { cells: null, borders: null, edges: null, circles: null, sites: null };
    for (const name of Object.keys(parts)) parts[name] = new Close(this.camera);
    const wanted = new Set(this.wanted);
    const { surface, layers } = this;
    for (const { chunk } of views) {
      for (let j = chunk.begin; j < chunk.end; ++j) {
        const site = surface.order[j];
        if (wanted.has("edges")) edgesOf(surface, site, parts.edges.arc);
        if (wanted.has("borders")) bordersOf(surface, site, parts.borders.arc);
        if (wanted.has("circles")) this.circlesOf(site, parts.circles.arc);
        if (wanted.has("cells")) {
          const ring = surface.ring(site);
          if (ring.length > 0) parts.cells.cell(ring, layers.levelOf(site));
        }
        parts.sites.site(surface.direction(site), layers.levelOf(site));
      }
    }
    return parts;
  }

  drawLines(name, views, close, paint, share) {
    for (const { chunk, spacing: pixels } of views) {
      const { buffers, count } = chunk.parts[name];
      this.canvas.drawLines(buffers[0], count, chunk.center, paint, share * lineWidth(pixels));
    }
    this.drawCut(close, paint, share * widestLine);
  }

  drawCut(close, paint, width) {
    const { canvas } = this;
    canvas.refill(canvas.loose.lines, new Float32Array(close.segments));
    canvas.drawLines(canvas.loose.lines, close.segments.length / 6, null, paint, width);
  }

  drawCells(views, close, theme) {
    const { canvas } = this;
    for (const { chunk } of views) {
      const { buffers, count } = chunk.parts.cells;
      canvas.drawCells(buffers[0], buffers[1], count, chunk.center, theme);
    }
    canvas.refill(canvas.loose.corners, new Float32Array(close.corners));
    canvas.refill(canvas.loose.indices, new Uint32Array(close.indices), canvas.gl.ELEMENT_ARRAY_BUFFER);
    canvas.drawCells(canvas.loose.corners, canvas.loose.indices, close.indices.length, null, theme);
  }

  // Points as wide as their cells, or as fine as dots where cells have no color.
  drawCoarse(views, theme) {
    const total = views.reduce((sum, { chunk }) => sum + chunk.end - chunk.begin, 0);
    const share = Math.min(1, mostCoarse / Math.max(1, total));
    for (const { chunk, spacing: pixels } of views) {
      const count = Math.ceil(share * (chunk.end - chunk.begin));
      const apart = pixels / Math.sqrt(share);
      const { isFilled } = this.layers;
      const size = isFilled ? Math.max(1.5, 1.5 * apart) : Math.min(2, Math.max(0.8, 0.4 * apart));
      const look = { size, ink: Math.min(1, Math.max(0.12, 0.3 * apart)), isFilled };
      this.canvas.drawSites(this.sitesBuffer, chunk.begin, count, chunk.center, theme, look);
    }
  }

  drawSites(views, close, theme) {
    const { canvas } = this;
    for (const { chunk, spacing: pixels } of views) {
      canvas.drawSites(this.sitesBuffer, chunk.begin, chunk.end - chunk.begin, chunk.center, theme, dotLook(pixels));
    }
    canvas.refill(canvas.loose.sites, new Float32Array(close.sites));
    canvas.drawSites(canvas.loose.sites, 0, close.sites.length / 4, null, theme, dotLook(Infinity));
  }

  drawChosen(theme) {
    for (const [things, paint, width] of [[this.pointed, theme.pointed, 2], [this.chosen, theme.chosen, 3]]) {
      const close = new Close(this.camera);
      for (const thing of things) {
        if (thing.ring) outline(close, thing.ring);
        if (thing.place) mark(close, thing.place, thing.pixels);
      }
      this.drawCut(close, paint, width);
    }
    const close = new Close(this.camera);
    for (const { axis, radius } of this.circled) circle(axis, radius, close.arc);
    this.drawCut(close, theme.circle, widestLine);
  }
}

// Lines and dots get smaller where sites get close, so that dense places do not turn into ink.
const widestDot = 3.6;

function lineWidth(pixels) {
  return Math.min(widestLine, Math.max(0.3, pixels / 12));
}

function dotLook(pixels) {
  return { size: Math.min(widestDot, Math.max(0.7, pixels / 5)), ink: 1, isFilled: false };
}

function greatestDivisor(a, b) {
  return b === 0 ? a : greatestDivisor(b, a % b);
}
