// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A globe whose sites come, go and move: each state of the worker takes the place of the one before.

import { circle } from "../../../viewer/src/arcs.js";
import { Finder } from "../../../viewer/src/find.js";
import { Globe } from "../../../viewer/src/globe.js";
import { Layers } from "../../../viewer/src/layers.js";
import { summary } from "../../../viewer/src/panel.js";
import { none, Surface } from "../../../viewer/src/surface.js";
import { lengthOf, triple } from "../../../viewer/src/vectors.js";
import { Groups } from "./groups.js";

// Colors keep their meaning while a site is dragged: the range is that of the last rest.
export class LiveLayers extends Layers {
  constructor(about, arrays, surface) {
    super(about, arrays, surface);
    this.fills.push({ key: "neighbors", name: "Number of neighbors", values: null });
    this.follow(surface);
    this.setFill(about.fill);
  }

  follow(surface) {
    this.surface = surface;
    for (const fill of this.fills) {
      if (fill.key === "area") fill.values = surface.areas;
      if (fill.key === "neighbors") fill.values = numbersOfNeighbors(surface);
    }
  }

  levelOf(site) {
    if (this.surface.isHidden(site) || !this.isFilled) return super.levelOf(site);
    return this.fill.values[site] > 0 ? Math.min(1, Math.max(0, super.levelOf(site))) : -1;
  }
}

function numbersOfNeighbors({ starOffsets, numSites, ringOfVertices }) {
  const numbers = new Float64Array(numSites);
  for (let site = 0; site < numSites; ++site) numbers[site] = starOffsets[site + 1] - starOffsets[site];
  for (const site of ringOfVertices) numbers[site] = Math.min(2, ringOfVertices.length - 1);
  return numbers.map((number) => (number > 0 ? number : NaN));
}

// The empty circle of a face: how far its corners are from its center, through the sphere.
function faceChord({ points, directions, faces }, face) {
  const p = 3 * face;
  const v = 3 * faces[p];
  const x = points[p] - directions[v], y = points[p + 1] - directions[v + 1], z = points[p + 2] - directions[v + 2];
  return Math.sqrt(x * x + y * y + z * z);
}

// The circle's radius as an angle.
function faceRadius(surface, face) {
  return 2 * Math.asin(Math.min(1, faceChord(surface, face) / 2));
}

// For each site a radius: of its own circle, or so much that its faces' circles are within it, for which an angle is at
// most half pi times its chord.
function radiiOf(surface) {
  const radii = new Float64Array(surface.numSites);
  if (surface.lengths !== null) {
    surface.lengths.forEach((length, site) => { radii[site] = length > 1 ? Math.atan(Math.sqrt((length - 1) * (length + 1))) : 0; });
    return radii;
  }
  for (let face = 0; face < surface.numFaces; ++face) {
    const radius = Math.PI * faceChord(surface, face);
    for (let h = 3 * face; h < 3 * face + 3; ++h) {
      const site = surface.faces[h];
      if (radius > radii[site]) radii[site] = radius;
    }
  }
  return radii;
}

// The circles that a site draws: its own, or those of the faces whose lowest corner it is.
function circlesOf(surface, radii, site, arc) {
  if (surface.lengths !== null) {
    circle(surface.direction(site), radii[site], arc);
    return;
  }
  for (let j = surface.starOffsets[site]; j < surface.starOffsets[site + 1]; ++j) {
    const face = surface.starFaces[j];
    if (Math.min(...surface.corners(face)) === site) circle(triple(surface.points, face), faceRadius(surface, face), arc);
  }
}

// How the globe looks at first.
const settings = {
  show: "both", showSites: true, circles: false, coast: true, graticule: 30, fill: "none", valueName: "",
  view: [10, 25], up: 0, closeness: 1, columns: [],
};

export class LiveGlobe extends Globe {
  constructor(page, state, coast) {
    super(page, { ...settings, ...state.about }, { ...state.arrays, coast });
    this.camera.share = 0.41;  // room for the tools below the globe
    this.home();
    this.scene.circlesOf = (site, arc) => circlesOf(this.surface, this.radii, site, arc);
    this.surface.isPlain = state.about.isPlain;
    this.radii = radiiOf(this.surface);
    this.groups = new Groups(this.surface, this.radii);
  }

  makeLayers(about, arrays) {
    return new LiveLayers(about, arrays, this.surface);
  }

  connectSearch() {}

  get hasCircles() {
    return true;
  }

  // The circles that pass through a site: those of its faces, which are empty; or its own one.
  circlesAt(site) {
    const { surface, radii } = this;
    if (surface.lengths !== null) return [{ axis: surface.direction(site), radius: radii[site] }];
    const faces = surface.starFaces.subarray(surface.starOffsets[site], surface.starOffsets[site + 1]);
    return Array.from(faces, (face) => ({ axis: triple(surface.points, face), radius: faceRadius(surface, face) }));
  }

  // All is new: another set of sites.
  replace(state) {
    this.choose(null);
    this.take(state);
    this.groups.renew(this.surface, this.radii);
    this.finish();
    this.rest();
  }

  // Some sites changed.
  follow(state) {
    this.take(state);
    this.groups.follow(this.surface, this.radii);
    this.finish();
  }

  take({ about, arrays }) {
    this.about = { ...this.about, ...about, sites: about.keys };
    this.surface = new Surface(this.about, arrays);
    this.about.sites = about.sites;
    this.surface.isPlain = about.isPlain;
    this.radii = radiiOf(this.surface);
    this.layers.follow(this.surface);
  }

  finish() {
    const { surface } = this;
    const chunks = this.groups.chunks.filter(({ begin, end }) => begin < end);
    this.finder = new Finder(surface, chunks);
    this.scene.update(surface, chunks, this.radii);
    this.panel.byId("summary").textContent = summary(this.about);
    Object.assign(this.card, { surface, layers: this.layers, radii: surface.lengths === null ? null : this.radii });
    this.refresh();
    this.redraw();
  }

  // What is chosen and what is below the pointer, as it is now.
  refresh() {
    const { picked } = this;
    if (!picked) return;
    if (picked.place !== null) this.choose(this.pick(picked.place));
    else this.choose(this.isThere(picked.site) ? { site: picked.site, face: none, place: null } : null);
  }

  isThere(site) {
    return site < this.surface.numSites && lengthOf(this.surface.direction(site)) > 0;
  }

  // Nothing moves any more: colors span the values that there are.
  rest() {
    const before = [...this.layers.range];
    this.layers.setFill(this.layers.fill.key);
    const isSame = this.layers.range.every((value, i) => value === before[i]);
    if (isSame) return;
    for (const chunk of this.scene.chunks) chunk.isUrgent = true;
    this.panel.drawLegend();
    this.recolor();
  }
}
