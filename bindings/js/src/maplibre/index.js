// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/**
 * Cells, triangles and isolines of irregular sites as layers of MapLibre GL JS 5 or later, on its globe and on its map.
 *
 *     const sites = await SphereSites.open({ lon, lat, values });
 *     map.addLayer(new SphereLayer({ id: "temperature", sites, show: "cells", domain: [-30, 40] }));
 *     map.on("click", async ({ lngLat }) => console.log(await sites.at(lngLat.lng, lngLat.lat)));
 * @module
 */

import { named, shown } from "../arguments.js";
import { layerOptions, Painter } from "../layers/painter.js";

export { SphereSites } from "../layers/sites.js";

/** @typedef {import("../layers/painter.js").LayerOptions} LayerOptions */
/** @typedef {import("../layers/sites.js").Picked} Picked */
/** @typedef {import("../layers/sites.js").SitesOptions} SitesOptions */

/**
 * The parts of a map that a layer uses.
 * @typedef {object} HostMap
 * @property {() => void} triggerRepaint
 * @property {() => {getWest(): number, getEast(): number}} getBounds
 * @property {() => boolean} getRenderWorldCopies
 * @property {() => number} getPixelRatio
 */

/**
 * The parts of MapLibre's CustomRenderMethodInput that a layer uses.
 * @typedef {object} HostProjection
 * @property {{mainMatrix: ArrayLike<number>, fallbackMatrix: ArrayLike<number>, clippingPlane: ArrayLike<number>,
 *   projectionTransition: number}} defaultProjectionData
 */

/**
 * The globe of MapLibre has its axes in the order y, z, x of ours.
 * @param {HostProjection["defaultProjectionData"]} data
 */
function globeView({ mainMatrix, clippingPlane }) {
  const m = Array.from(mainMatrix);
  return {
    isGlobe: true,
    matrix: [...m.slice(8, 12), ...m.slice(0, 4), ...m.slice(4, 8), ...m.slice(12, 16)],
    horizon: [clippingPlane[2], clippingPlane[0], clippingPlane[1], clippingPlane[3]],
  };
}

/** A layer for `map.addLayer()`. */
export class SphereLayer {
  /** @type {"custom"} */
  type = "custom";
  /** @type {"2d"} */
  renderingMode = "2d";
  /** @type {HostMap | undefined} */
  #map;
  #painter;

  /** @param {LayerOptions & {id: string}} options */
  constructor(options) {
    const { id, ...others } = named(options, ["id", ...layerOptions]);
    if (typeof id !== "string") throw new TypeError(`id is ${shown(id)}, not a text`);
    this.id = id;
    this.#painter = new Painter(others, () => this.#map?.triggerRepaint());
  }

  /** Resolves when what the layer shows can be drawn. */
  get loaded() {
    return this.#painter.loaded;
  }

  /** Changes some options. @param {Partial<LayerOptions>} options */
  setOptions(options) {
    this.#painter.setOptions({ ...this.#painter.options, ...named(options) });
  }

  /** MapLibre calls this. @param {HostMap} map */
  onAdd(map) {
    this.#map = map;
  }

  /** MapLibre calls this. */
  onRemove() {
    this.#painter.free();
    this.#map = undefined;
  }

  /** The turns of the world that are on the screen. @returns {[number, number]} */
  #copies() {
    if (!this.#map?.getRenderWorldCopies()) return [0, 0];
    const bounds = this.#map.getBounds();
    return [Math.floor((bounds.getWest() + 180) / 360), Math.floor((bounds.getEast() + 180) / 360)];
  }

  /**
   * MapLibre calls this.
   * @param {WebGLRenderingContext | WebGL2RenderingContext} context WebGL 2
   * @param {HostProjection} projection
   */
  render(context, { defaultProjectionData: data }) {
    const gl = /** @type {WebGL2RenderingContext} */ (context);
    const isGlobe = data.projectionTransition > 0.5;
    const place = isGlobe
      ? globeView(data)
      : { isGlobe, matrix: data.fallbackMatrix, horizon: [0, 0, 0, 0] };
    this.#painter.draw(
      gl,
      { ...place, copies: isGlobe ? [0, 0] : this.#copies(), viewport: [gl.drawingBufferWidth, gl.drawingBufferHeight] },
      { pixelRatio: this.#map?.getPixelRatio() ?? 1, isPremultiplied: true },
    );
  }
}
