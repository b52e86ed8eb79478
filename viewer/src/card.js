// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What is known of the site, its cell and the triangle that were picked.

import { areaText, count, digits, lengthText, placeText } from "./numbers.js";
import { none } from "./surface.js";
import { angleBetween, lonLatOf, triple } from "./vectors.js";

function row(list, name, value) {
  const term = document.createElement("dt");
  const text = document.createElement("dd");
  term.textContent = name;
  if (value instanceof Node) text.append(value);
  else text.textContent = value;
  list.append(term, text);
}

function heading(text) {
  const element = document.createElement("h3");
  element.textContent = text;
  return element;
}

export class Card {
  // `choose(site)` is called for sites that are named in the card.
  constructor(element, { surface, columns, layers, radii, choose }) {
    Object.assign(this, { element, surface, columns, layers, radii, choose });
    this.body = element.querySelector(".card-body");
    this.title = element.querySelector("h2");
  }

  // `picked`: {site, face, place}; null hides the card.
  show(picked) {
    this.element.hidden = picked === null;
    if (picked === null) return;
    const { site, face, place } = picked;
    this.title.textContent = site === none ? "No site" : `Site ${site}`;
    this.body.replaceChildren();
    if (site !== none) this.body.append(this.siteRows(site, place));
    if (face !== none) this.body.append(heading(`Triangle ${face}`), this.faceRows(face));
    if (face === none && place !== null && this.surface.dimension === 2) {
      this.body.append(heading("No triangle"), "The center of the sphere sees no triangle here.");
    }
  }

  siteRows(site, place) {
    const { surface } = this;
    const list = document.createElement("dl");
    const direction = surface.direction(site);
    for (const column of this.columns) row(list, column.name, column.cell(site) || "\u2013");
    row(list, "Position", placeText(lonLatOf(direction), 1e6));
    if (this.radii !== null && this.radii[site] > 0) row(list, "Radius of the circle", lengthText(this.radii[site]));
    const { fill } = this.layers;
    if (fill.key === "values" && !this.columns.some(({ name }) => name === fill.name)) row(list, fill.name, digits(fill.values[site], 8));
    this.stateRows(list, site);
    if (place !== null) row(list, "Distance", lengthText(angleBetween(direction, place)));
    return list;
  }

  stateRows(list, site) {
    const { surface } = this;
    if (surface.representative.has(site)) {
      row(list, "Duplicate of", this.links([surface.representative.get(site)]));
      return;
    }
    if (surface.isHidden(site)) {
      const face = surface.faceAbove.get(site);
      row(list, "Hidden", face === none ? "not a vertex" : `below triangle ${face}`);
      return;
    }
    row(list, "Area of the cell", areaText(surface.areas[site]));
    const neighbors = surface.neighborsOf(site);
    const few = neighbors.slice(0, 24);
    row(list, count(neighbors.length, "neighbor"), this.links(few));
  }

  faceRows(face) {
    const { surface } = this;
    const list = document.createElement("dl");
    row(list, "Corners", this.links(surface.corners(face)));
    row(list, "Area", surface.isGhost[face] === 1 ? "ghost: not seen from the center" : areaText(surface.faceArea(face)));
    row(list, "Circumcenter", placeText(lonLatOf(triple(surface.points, face)), 1e5));
    return list;
  }

  links(sites) {
    const group = document.createElement("span");
    group.className = "links";
    for (const site of sites) {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = site;
      button.setAttribute("aria-label", `Go to site ${site}`);
      button.addEventListener("click", () => this.choose(site));
      group.append(button);
    }
    return group;
  }
}
