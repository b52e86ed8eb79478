// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A painter serves the layers of all hosts: it asks for what they show, keeps it on the graphics card, and draws it.

import { defaultColors, ramp, rgba } from "./colors.js";
import { Renderer } from "./renderer.js";
import { finiteNumbers, named, number, shown } from "../arguments.js";
import { RondelError } from "../errors.js";
import { vertexValues } from "../surface/meshes.js";
import { drawnOptions } from "../surface/options.js";

/** @typedef {import("./colors.js").Color} Color */
/** @typedef {import("./renderer.js").View} View */
/** @typedef {import("./sites.js").SphereSites} SphereSites */

/**
 * @typedef {object} LayerOptions
 * @property {SphereSites} sites
 * @property {import("../surface/options.js").Show} [show] "cells" (the default: each has the color of its site),
 *   "triangles" (colors are linear in each), "isolines", "cell-borders" or "triangle-borders"
 * @property {readonly Color[]} [colors] from the first to the last value of `domain`
 * @property {readonly [number, number]} [domain] default: the least and the largest value
 * @property {import("../arguments.js").Numbers} [levels] isolines: the values of the lines
 * @property {Color} [lineColor] lines: one color in place of `colors`; default of borders: black
 * @property {number} [lineWidth] lines: CSS pixels; default 1
 * @property {number} [opacity] from 0 to 1; default 1
 * @property {number} [spacing] degrees: sides that are longer are divided, so that they follow the globe; default 2
 */

/** The names of LayerOptions. */
export const layerOptions = ["sites", "show", "colors", "domain", "levels", "lineColor", "lineWidth", "opacity", "spacing"];

/**
 * Returns the options if they can be drawn; otherwise the error comes now, not when the host draws.
 * @param {LayerOptions} options
 */
export function checkedLayer(options) {
  const { sites, show, spacing, levels, ...look } = named(options, layerOptions);
  const { colors, domain, lineColor, lineWidth = 1, opacity = 1 } = look;
  if (typeof sites?.onChange !== "function") {
    throw new TypeError(`sites: what SphereSites.open() returns is wanted, not ${shown(sites)}`);
  }
  drawnOptions({ show, spacing, levels });
  if (colors !== undefined) ramp(colors);
  if (lineColor !== undefined) rgba(lineColor, "lineColor");
  number(lineWidth, "lineWidth", 0);
  number(opacity, "opacity", 0, 1);
  if (domain !== undefined && finiteNumbers(domain, "domain").length !== 2) {
    throw new RondelError(`domain: two numbers are wanted, not ${domain.length}`, 0);
  }
  return options;
}

/** One layer's drawing. */
export class Painter {
  /** @type {Renderer | undefined} */
  #renderer;
  /** @type {import("../surface/meshes.js").Mesh | import("../surface/lines.js").Lines | undefined} */
  #drawn;
  #drawnValues = -1;
  /** @type {readonly Color[] | undefined} */
  #drawnColors;
  #stopListening = () => {};
  #request = 0;

  /**
   * @param {LayerOptions} options
   * @param {() => void} redraw asks the host to draw
   */
  constructor(options, redraw) {
    this.options = checkedLayer(options);
    this.redraw = redraw;
    this.listen();
    /** Whether what the layer shows can be drawn. */
    this.isLoaded = false;
    /** Resolves when what the layer shows can be drawn. @type {Promise<void>} */
    this.loaded = this.load();
  }

  listen() {
    this.#stopListening();
    this.#stopListening = this.options.sites.onChange(() => {
      if (this.options.show === "isolines") this.loaded = this.load();
      else this.redraw();
    });
  }

  /** Asks for what is shown. An older answer that comes later is not taken. */
  async load() {
    const request = ++this.#request;
    this.isLoaded = false;
    const { sites, show, spacing, levels } = this.options;
    const drawn = await sites.drawn({ show, spacing, levels });
    if (request !== this.#request) return;
    this.next = drawn;
    this.isLoaded = true;
    this.redraw();
  }

  /** @param {LayerOptions} options */
  setOptions(options) {
    const before = this.options;
    this.options = checkedLayer(options);
    if (before.sites !== options.sites) this.listen();
    const levels = (/** @type {LayerOptions} */ { levels: list }) => Array.from(list ?? []).join();
    const isSame =
      before.sites === options.sites &&
      before.show === options.show &&
      before.spacing === options.spacing &&
      levels(before) === levels(options);
    if (!isSame) this.loaded = this.load();
    else this.redraw();
  }

  /** Brings what has changed to the graphics card. @param {WebGL2RenderingContext} gl */
  #update(gl) {
    if (this.next) {
      this.#renderer?.free();
      this.#renderer = new Renderer(gl, this.next);
      this.#drawn = this.next;
      this.next = undefined;
      this.#drawnValues = -1;
      this.#drawnColors = undefined;
    }
    const { sites, colors = defaultColors } = this.options;
    if (!this.#renderer || !this.#drawn) return;
    if ("indices" in this.#drawn && this.#drawnValues !== sites.valuesChanged) {
      this.#renderer.setValues(vertexValues(this.#drawn, sites.values));
      this.#drawnValues = sites.valuesChanged;
    }
    if (this.#drawnColors !== colors) {
      this.#renderer.setColors(colors);
      this.#drawnColors = colors;
    }
  }

  /**
   * Draws, if there is something to draw.
   * @param {WebGL2RenderingContext} gl
   * @param {View} view
   * @param {{pixelRatio: number, isPremultiplied: boolean, pickedAlpha?: number, opacity?: number}} host
   */
  draw(gl, view, { pixelRatio, isPremultiplied, pickedAlpha = 0, opacity = 1 }) {
    this.#update(gl);
    const renderer = this.#renderer;
    if (!renderer || !this.#drawn) return;
    const isBorder = renderer.isLines && this.#drawn.show !== "isolines";
    const { sites, domain, lineColor = isBorder ? "#000000" : undefined, lineWidth = 1 } = this.options;
    const hasDepth = gl.isEnabled(gl.DEPTH_TEST);
    const isCulled = gl.isEnabled(gl.CULL_FACE);
    gl.disable(gl.DEPTH_TEST); // the horizon is a plane of its own, and layers lie on each other in their order
    gl.disable(gl.CULL_FACE);
    renderer.draw(view, {
      domain: /** @type {[number, number]} */ (domain ?? sites.extent),
      color: renderer.isLines && lineColor ? rgba(lineColor, "lineColor").map((part) => part / 255) : [0, 0, 0, 0],
      opacity: opacity * (this.options.opacity ?? 1),
      width: lineWidth * pixelRatio,
      isPremultiplied,
      pickedAlpha,
    });
    if (hasDepth) gl.enable(gl.DEPTH_TEST);
    if (isCulled) gl.enable(gl.CULL_FACE);
  }

  /** Frees what the graphics card has. The layer may be drawn again. */
  free() {
    this.#renderer?.free();
    this.#renderer = undefined;
    this.next ??= this.#drawn;
    this.#drawn = undefined;
  }

  /** Ends the layer. */
  end() {
    this.#stopListening();
    this.free();
  }
}
