// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The controls around the globe: what is shown, colors, the color bar, the theme, help.

import { areaUnit, count, scaleBar, shortNumbers } from "./numbers.js";
import { colorAt } from "./colors.js";

const toggles = ["edges", "borders", "sites", "circles", "isolines", "coast", "graticule"];

export function summary(about) {
  const kind = about.model === "weighted" ? "Regular triangulation and power diagram" : "Delaunay triangulation and Voronoi diagram";
  const parts = [count(about.sites, "site")];
  if (about.dimension === 2) parts.push(count(about.faces, "triangle"));
  if (about.vertices !== about.sites) parts.push(about.vertices === 1 ? "1 vertex" : `${about.vertices.toLocaleString("en")} vertices`);
  if (about.duplicates > 0) parts.push(count(about.duplicates, "duplicate"));
  if (about.hidden > 0) parts.push(`${about.hidden.toLocaleString("en")} hidden`);
  if (about.ghosts > 0) parts.push(`${about.ghosts.toLocaleString("en")} ghost faces`);
  return `${kind} of ${parts.join(", ")}. ${shape(about)}`.trim();
}

function shape({ sites, dimension, ghosts }) {
  if (sites === 0) return "There is no site.";
  if (dimension === 0) return "All sites are in one place: its cell is the whole sphere.";
  if (dimension === 1) return "All sites are on one great circle: there are no triangles.";
  return ghosts > 0 ? "The center of the sphere is not inside the triangulation." : "";
}

export class Panel {
  // `globe` has: layers, redraw(), recolor(), setTheme(name).
  constructor(page, about, globe) {
    this.page = page;
    this.globe = globe;
    this.byId = (id) => page.getElementById(id);
    this.byId("summary").textContent = summary(about);
    for (const name of toggles) this.bindToggle(name);
    this.byId("show-circles").closest("label").hidden = !globe.hasCircles;
    this.byId("show-isolines").closest("label").hidden = !globe.hasIsolines;
    this.bindFill();
    this.bindTheme();
    this.bindHelp();
    this.bindFolding();
  }

  bindToggle(name) {
    const box = this.byId(`show-${name}`);
    box.checked = this.globe.layers[name];
    box.addEventListener("change", () => {
      this.globe.layers[name] = box.checked;
      this.globe.redraw();
    });
  }

  bindFill() {
    const select = this.byId("fill");
    for (const { key, name } of this.globe.layers.fills) select.add(new Option(name, key));
    select.value = this.globe.layers.fill.key;
    select.addEventListener("change", () => {
      this.globe.layers.setFill(select.value);
      this.globe.recolor();
      this.drawLegend();
    });
    this.drawLegend();
  }

  drawLegend() {
    const { layers } = this.globe;
    const legend = this.byId("legend");
    legend.hidden = !layers.isFilled;
    if (legend.hidden) return;
    const steps = Array.from({ length: 17 }, (_, i) => colorAt(i / 16).map((c) => Math.round(255 * c)));
    this.byId("legend-bar").style.background = `linear-gradient(to right, ${steps.map((c) => `rgb(${c})`)})`;
    const [low, high] = layers.range;
    const middle = layers.fill.isLogarithmic ? Math.sqrt(low * high) : low / 2 + high / 2;
    const { unit, size } = layers.fill.key === "area" ? areaUnit(high) : { unit: "", size: 1 };
    const texts = shortNumbers([low, middle, high].map((value) => value / size));
    texts.forEach((text, i) => {
      this.byId(`legend-${i}`).textContent = low < high || i === 1 ? text : "";
    });
    this.byId("legend-name").textContent = unit === "" ? layers.fill.name : `${layers.fill.name}, ${unit}`;
    this.byId("legend-bar").setAttribute("aria-label", `Colors from ${texts[0]} to ${texts[2]} ${unit}`.trim());
  }

  bindTheme() {
    const wished = matchMedia("(prefers-color-scheme: dark)");
    const button = this.byId("theme");
    const apply = (name) => {
      this.page.documentElement.dataset.theme = name;
      button.setAttribute("aria-pressed", String(name === "dark"));
      this.globe.setTheme(name);
    };
    apply(wished.matches ? "dark" : "light");
    wished.addEventListener("change", () => apply(wished.matches ? "dark" : "light"));
    button.addEventListener("click", () => apply(this.page.documentElement.dataset.theme === "dark" ? "light" : "dark"));
  }

  bindHelp() {
    this.help = this.byId("help");
    this.byId("help-open").addEventListener("click", () => this.help.showModal());
    this.byId("help-close").addEventListener("click", () => this.help.close());
  }

  // On a small screen the controls are folded at first.
  bindFolding() {
    const button = this.byId("fold");
    const content = this.byId("panel-content");
    const apply = (isOpen) => {
      content.hidden = !isOpen;
      button.setAttribute("aria-expanded", String(isOpen));
    };
    apply(!matchMedia("(max-width: 640px), (max-height: 560px)").matches);
    button.addEventListener("click", () => apply(content.hidden));
  }

  // After each frame: the scale and the compass.
  follow(camera) {
    const { text, pixels } = scaleBar(camera.zoom, 120);
    this.byId("scale-text").textContent = text;
    this.byId("scale-bar").style.width = `${pixels}px`;
    this.byId("needle").style.transform = `rotate(${-camera.bearing}deg)`;
  }
}
