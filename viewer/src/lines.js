// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The lines that are not of single sites: coasts, isolines, and the net of meridians and parallels.

import { graticule } from "./arcs.js";
import { coastChords } from "./backdrop.js";
import { Close } from "./close.js";
import { isolineArcs } from "./isolines.js";
import { Segments } from "./shapes.js";
import { lonLatOf } from "./vectors.js";

export class Lines {
  // `given` has the rings of the coast, and isolines and isolineEnds if there are any; `scene` draws what was cut.
  constructor(canvas, camera, layers, given, scene) {
    Object.assign(this, { canvas, camera, layers, given, scene });
    this.keep();
  }

  get hasIsolines() {
    return this.given.isolines !== undefined;
  }

  keep() {
    this.coastLines = this.keepLines((lines) => coastChords(this.given.coast, lines.chord));
    this.netLines = this.keepLines((lines) => graticule(this.layers.graticuleStep, [0, 0], 180, lines.chord));
    this.valueLines = this.keepLines((lines) => this.hasIsolines && isolineArcs(this.given, lines.arc));
  }

  // What is drawn as it is until the zoom is large. `trace` gives the lines to a Segments.
  keepLines(trace) {
    const lines = new Segments([0, 0, 0]);
    trace(lines);
    return { buffer: this.canvas.keep(lines.data), count: lines.count };
  }

  // Coasts, isolines and the net of meridians and parallels, which is finer where the zoom is larger.
  draw(theme) {
    const { canvas, camera, layers } = this;
    if (layers.graticule) {
      const step = this.netStep();
      if (step === layers.graticuleStep && isFar(camera)) {
        canvas.drawLines(this.netLines.buffer, this.netLines.count, [0, 0, 0], theme.graticule, 1);
      } else {
        const net = new Close(camera);
        graticule(step, lonLatOf(camera.forward), camera.reach * 60, net.arc);
        this.scene.drawCut(net, theme.graticule, 1);
      }
    }
    if (layers.coast) this.drawKept(this.coastLines, (close) => coastChords(this.given.coast, close.arc), theme.coast, 1);
    if (layers.isolines) {
      this.drawKept(this.valueLines, (close) => isolineArcs(this.given, close.arc), theme.isoline, widestLine);
    }
  }

  // Lines of keepLines(); where 32 bits are not enough, traced again.
  drawKept(lines, trace, paint, width) {
    if (isFar(this.camera)) {
      this.canvas.drawLines(lines.buffer, lines.count, [0, 0, 0], paint, width);
      return;
    }
    const close = new Close(this.camera);
    trace(close);
    this.scene.drawCut(close, paint, width);
  }

  // Degrees between meridians: at least 100 pixels, beyond the first step 10, 5, 2, 1, 0.5 ...
  netStep() {
    const { zoom } = this.camera;
    let step = this.layers.graticuleStep;
    for (const next of netSteps) {
      if (next < step && (next * Math.PI / 180) * zoom >= 160) step = next;
    }
    return step;
  }
}

export const widestLine = 1.5;

// Whether 32 bits from the center are fine enough for lines.
function isFar(camera) {
  return camera.zoom <= 20_000;
}

const netSteps = [];
for (let power = 1; power > -9; --power) {
  for (const digit of [5, 2, 1]) netSteps.push(digit * 10 ** power);
}
