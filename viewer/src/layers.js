// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the page can show, and which value each site has.

export class Layers {
  constructor(about, arrays, surface) {
    this.surface = surface;
    this.edges = about.show !== "voronoi";
    this.borders = about.show !== "delaunay";
    this.sites = about.showSites;
    this.circles = about.circles;
    this.coast = about.coast;
    this.isolines = arrays.isolines !== undefined;
    this.graticule = about.graticule > 0;
    this.graticuleStep = about.graticule > 0 ? about.graticule : 30;
    this.fills = [{ key: "none", name: "None", values: null }];
    this.fills.push({ key: "area", name: "Area of the cell", values: surface.areas, isLogarithmic: true });
    if (arrays.values) this.fills.push({ key: "values", name: about.valueName, values: arrays.values });
    this.fill = null;
    this.setFill(about.fill);
  }

  // `key` of one of the fills.
  setFill(key) {
    this.fill = this.fills.find((fill) => fill.key === key) ?? this.fills[0];
    const { values, isLogarithmic } = this.fill;
    this.range = [Infinity, -Infinity];
    if (values === null) return;
    for (const value of values) {
      if (!Number.isFinite(value) || (isLogarithmic && value <= 0)) continue;
      if (value < this.range[0]) this.range[0] = value;
      if (value > this.range[1]) this.range[1] = value;
    }
  }

  get isFilled() {
    return this.fill.values !== null && this.range[0] <= this.range[1];
  }

  // Where a site is in the color map, from 0 to 1; -1 without a value, -10 of a hidden site.
  levelOf(site) {
    if (this.surface.isHidden(site)) return -10;
    if (!this.isFilled) return -1;
    const value = this.fill.values[site];
    const [low, high] = this.range;
    if (!Number.isFinite(value) || (this.fill.isLogarithmic && value <= 0)) return -1;
    if (low === high) return 0.5;
    if (this.fill.isLogarithmic) return Math.log(value / low) / Math.log(high / low);
    if (high - low === Infinity) return (value / 2 - low / 2) / (high / 2 - low / 2);
    return (value - low) / (high - low);
  }
}
