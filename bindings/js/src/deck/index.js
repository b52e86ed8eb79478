// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/**
 * Cells, triangles and isolines of irregular sites as layers of deck.gl 9, in its GlobeView and its MapView (WebGL 2).
 *
 *     const sites = await SphereSites.open({ lon, lat, values });
 *     new Deck({ views: new _GlobeView(), layers: [new SphereLayer({ id: "cells", sites, pickable: true })], ... });
 *
 * Cells are pickable: `info.index` is the site, `info.object` what `sites.at()` returns.
 * @module
 */

import { Layer } from "@deck.gl/core";
import { checkedLayer, layerOptions, Painter } from "../layers/painter.js";

export { SphereSites } from "../layers/sites.js";

/** @typedef {import("../layers/painter.js").LayerOptions} LayerOptions */
/** @typedef {import("../layers/sites.js").Picked} Picked */
/** @typedef {import("../layers/sites.js").SitesOptions} SitesOptions */

const globeRadius = 256; // of deck.gl's common space
const worldSize = 512;
const globe = 2; // PROJECTION_MODE.GLOBE

/** A multiple of column k of a matrix of 4 x 4. @param {number[]} matrix @param {number} k @param {number} factor */
const column = (matrix, k, factor) => matrix.slice(4 * k, 4 * k + 4).map((entry) => factor * entry);

/**
 * On deck.gl's globe our axes x, y, z are -y, x, z. A place is seen if its tangent plane has the camera above it.
 * @param {any} viewport
 */
function globeView({ viewProjectionMatrix, cameraPosition }) {
  const m = Array.from(viewProjectionMatrix);
  const [a, b, c] = Array.from(cameraPosition, (part) => part / globeRadius);
  const distance = Math.hypot(a, b, c);
  return {
    isGlobe: true,
    matrix: [
      ...column(m, 1, -globeRadius),
      ...column(m, 0, globeRadius),
      ...column(m, 2, globeRadius),
      ...column(m, 3, 1),
    ],
    horizon: [-b / distance, a / distance, c / distance, -1 / distance],
  };
}

/** On deck.gl's map y goes to the north. @param {any} viewport */
function mapView({ viewProjectionMatrix }) {
  const m = Array.from(viewProjectionMatrix);
  const [up, origin] = [column(m, 1, worldSize), column(m, 3, 1)];
  return {
    isGlobe: false,
    matrix: [
      ...column(m, 0, worldSize),
      ...column(m, 1, -worldSize),
      ...column(m, 2, 1),
      ...origin.map((entry, k) => entry + up[k]),
    ],
    horizon: [0, 0, 0, 0],
  };
}

/** deck.gl's blending of layers. @param {WebGL2RenderingContext} gl */
const blending = (gl) => ({
  blend: true,
  blendEquation: gl.FUNC_ADD,
  blendFunc: [gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA],
});

const names = layerOptions.filter((name) => name !== "opacity");

/** The options of a layer in its props; deck.gl applies the opacity. @param {any} props @returns {LayerOptions} */
const optionsOf = (props) =>
  /** @type {any} */ (Object.fromEntries(names.map((name) => [name, props[name] ?? undefined])));

/**
 * A layer for `new Deck({ layers })`; it has the props of every layer, and those of LayerOptions.
 * @extends {Layer<LayerOptions>}
 */
export class SphereLayer extends Layer {
  /** @override */
  static layerName = "SphereLayer";
  /** @override */
  static defaultProps = {
    sites: { type: "object", value: null, compare: false },
    show: "cells",
    colors: { type: "array", value: null, optional: true, compare: true },
    domain: { type: "array", value: null, optional: true, compare: true },
    levels: { type: "array", value: null, optional: true, compare: true },
    lineColor: { type: "object", value: null, optional: true },
    lineWidth: 1,
    spacing: 2,
  };

  /** Tells now what is wrong, not when it is drawn. @param {(LayerOptions & Record<string, any>)[]} props */
  constructor(...props) {
    super(.../** @type {[any]} */ (props));
    checkedLayer(optionsOf(this.props));
  }

  /** @override */
  initializeState() {
    this.setState({ painter: new Painter(optionsOf(this.props), () => this.setNeedsRedraw()) });
  }

  /** Whether the layer draws what it shows. @override */
  get isLoaded() {
    return super.isLoaded && Boolean(/** @type {any} */ (this.state)?.painter?.isLoaded);
  }

  /** @override @param {any} parameters */
  updateState({ props, changeFlags }) {
    if (changeFlags.propsChanged) /** @type {any} */ (this.state).painter.setOptions(optionsOf(props));
  }

  /** @override @param {any} options */
  draw({ shaderModuleProps, parameters }) {
    const { device, gl } = /** @type {any} */ (this.context);
    const viewport = shaderModuleProps?.project?.viewport ?? this.context.viewport; // of maps, one for each turn
    const isPicking = Boolean(shaderModuleProps?.picking?.isActive);
    const isGlobe = viewport.projectionMode === globe;
    const pixelRatio = device.canvasContext?.cssToDeviceRatio?.() ?? 1;
    if (isPicking && this.props.show !== "cells") return;
    const view = {
      ...(isGlobe ? globeView(viewport) : mapView(viewport)),
      copies: /** @type {[number, number]} */ ([0, 0]),
      viewport: /** @type {[number, number]} */ ([viewport.width * pixelRatio, viewport.height * pixelRatio]),
    };
    // deck.gl tells layers apart by the alpha of what is picked.
    const pickedAlpha = isPicking ? (parameters?.blendColor?.[3] ?? 1) : undefined;
    device.withParametersWebGL(isPicking ? { blend: false } : blending(gl), () =>
      /** @type {any} */ (this.state).painter.draw(gl, view, {
        pixelRatio,
        isPremultiplied: false,
        pickedAlpha,
        opacity: this.props.opacity,
      }),
    );
  }

  /** Adds the site. @override @param {any} parameters */
  getPickingInfo(parameters) {
    const info = super.getPickingInfo(parameters);
    const { sites } = this.props;
    const { index: site } = info;
    if (site >= 0 && site < sites.numSites) {
      info.object = { site, value: sites.values[site], lon: sites.lon[site], lat: sites.lat[site] };
    }
    return info;
  }

  /** @override @param {any} context */
  finalizeState(context) {
    /** @type {any} */ (this.state).painter.end();
    super.finalizeState(context);
  }
}
