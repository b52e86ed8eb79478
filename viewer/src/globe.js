// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The globe: brings the parts of a page together.

import { readCoast, drawLand } from "./backdrop.js";
import { Camera } from "./camera.js";
import { Canvas } from "./canvas.js";
import { Card } from "./card.js";
import { makeChunks } from "./chunks.js";
import { themeOf } from "./colors.js";
import { Column } from "./decode.js";
import { Finder } from "./find.js";
import { Layers } from "./layers.js";
import { placeText } from "./numbers.js";
import { Panel } from "./panel.js";
import { Pointers, slowed } from "./pointer.js";
import { Scene } from "./scene.js";
import { Search } from "./search.js";
import { none, Surface } from "./surface.js";
import { alongArc, angleBetween, lonLatOf } from "./vectors.js";

export class Globe {
  constructor(page, about, arrays) {
    this.page = page;
    this.about = about;
    this.element = page.getElementById("globe");
    this.canvas = new Canvas(this.element, () => this.restore());
    this.surface = new Surface(about, arrays);
    this.radii = arrays.radii ?? null;
    this.layers = this.makeLayers(about, arrays);
    this.columns = about.columns.map((column, i) => new Column(column, arrays[`column${i}`], arrays[`column${i}Lengths`]));
    const chunks = makeChunks(this.surface, this.radii);
    this.chunks = chunks;
    this.finder = new Finder(this.surface, chunks);
    this.camera = new Camera();
    this.coast = readCoast(arrays.coast);
    this.canvas.setLand(drawLand(this.coast));
    const lines = { coast: this.coast, isolines: arrays.isolines, isolineEnds: arrays.isolineEnds };
    this.scene = new Scene(this.canvas, this.camera, this.surface, chunks, this.layers, this.radii, lines);
    this.theme = "light";
    this.connect();
  }

  connectSearch(choose) {
    const { page, columns, surface } = this;
    const [field, list] = ["search", "found"].map((id) => page.getElementById(id));
    this.search = new Search(field, list, { numSites: surface.numSites, columns, choose });
  }

  get hasCircles() {
    return this.radii !== null;
  }

  get hasIsolines() {
    return this.scene.lines.hasIsolines;
  }

  makeLayers(about, arrays) {
    return new Layers(about, arrays, this.surface);
  }

  connect() {
    const { page, surface, columns, layers, radii } = this;
    const byId = (id) => page.getElementById(id);
    const choose = (site) => this.goTo(site);
    this.panel = new Panel(page, this.about, this);
    this.card = new Card(byId("card"), { surface, columns, layers, radii, choose });
    this.connectSearch(choose);
    this.pointers = new Pointers(this.element, this);
    byId("card-close").addEventListener("click", () => this.choose(null));
    byId("zoom-in").addEventListener("click", () => this.zoomBy(1.6));
    byId("zoom-out").addEventListener("click", () => this.zoomBy(1 / 1.6));
    byId("home").addEventListener("click", () => this.home());
    byId("north").addEventListener("click", () => this.northUp());
    byId("save").addEventListener("click", () => this.save());
    new ResizeObserver(() => this.resize()).observe(this.element);
    this.resize();
    this.home();
  }

  resize() {
    const { clientWidth, clientHeight } = this.element;
    this.scale = Math.min(2, window.devicePixelRatio || 1);
    this.element.width = Math.max(1, Math.round(clientWidth * this.scale));
    this.element.height = Math.max(1, Math.round(clientHeight * this.scale));
    this.camera.resize(Math.max(1, clientWidth), Math.max(1, clientHeight));
    this.redraw();
  }

  // After the graphics processor lost all that it was given.
  restore() {
    this.canvas.setLand(drawLand(this.coast));
    this.scene.restore();
    this.redraw();
  }

  redraw() {
    this.isDrawn = false;
    this.frame ??= requestAnimationFrame((time) => {
      this.frame = undefined;
      this.step(time);
    });
  }

  step(time) {
    if (this.motion) this.motion(time);
    this.drawNow();
    if (this.motion || !this.scene.isSettled) this.redraw();
    else this.isDrawn = true;
  }

  drawNow() {
    this.scene.draw(themeOf(this.theme, this.layers.isFilled), this.scale);
    this.panel.follow(this.camera);
  }

  recolor() {
    this.scene.recolor();
    this.redraw();
  }

  setTheme(name) {
    this.theme = name;
    this.redraw();
  }

  home() {
    const { view, up } = this.about;
    this.stop();
    this.camera.lookAt(view[0], view[1], up);
    this.camera.setZoom(Math.max(this.camera.fittingZoom, this.about.closeness * this.camera.fittingZoom));
    this.redraw();
  }

  northUp() {
    this.camera.face(this.camera.forward, 0);
    this.redraw();
  }

  zoomBy(factor) {
    this.stop();
    this.camera.setZoom(this.camera.zoom * factor);
    this.redraw();
  }

  help() {
    this.panel.help.showModal();
  }

  stop() {
    this.motion = null;
  }

  // Turns on at a speed in pixels a millisecond.
  glide(speed) {
    let now = performance.now();
    let left = speed;
    this.motion = (time) => {
      const elapsed = Math.max(0, Math.min(50, time - now));
      now = time;
      this.camera.pan(left.x * elapsed, left.y * elapsed);
      left = slowed(left, elapsed);
      if (left === null) this.motion = null;
    };
    this.redraw();
  }

  // Turns so that a site is in the middle; from far away also nearer, so that it can be told from its neighbors.
  goTo(site) {
    const target = this.surface.direction(site);
    const from = this.camera.forward;
    const angle = angleBetween(from, target);
    const { bearing } = this.camera;
    const begin = performance.now();
    const duration = matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : 600;
    this.motion = (time) => {
      const part = duration === 0 ? 1 : Math.min(1, Math.max(0, (time - begin) / duration));
      const eased = part * part * (3 - 2 * part);
      this.camera.face(part === 1 ? target : alongArc(from, target, angle, eased), bearing);
      if (part === 1) this.motion = null;
    };
    this.choose({ site, face: none, place: null });
    this.redraw();
  }

  // What is at a place, a unit vector: the nearest site and the face that holds it.
  pick(place) {
    return { site: this.finder.nearest(place), face: this.finder.locate(place), place };
  }

  click(x, y) {
    const place = this.camera.placeAt(x, y);
    this.choose(place === null ? null : this.pick(place));
  }

  choose(picked) {
    this.picked = picked;
    this.card.show(picked);
    this.scene.chosen = picked === null ? [] : this.outlines(picked, 8);
    const site = picked === null || picked.site === none ? null : picked.site;
    this.page.getElementById("status").textContent = site === null ? "Nothing is chosen" : this.describe(picked);
    this.redraw();
  }

  describe({ site, face }) {
    const place = placeText(lonLatOf(this.surface.direction(site)), 1e4);
    return `Site ${site} at ${place}${face === none ? "" : `, triangle ${face}`}`;
  }

  outlines({ site, face }, pixels) {
    const { surface } = this;
    const things = [];
    if (site !== none) {
      things.push({ place: surface.direction(site), pixels });
      things.push({ ring: surface.ring(surface.representative.get(site) ?? site) });
    }
    if (face !== none && this.layers.edges) things.push({ ring: surface.corners(face).map((v) => surface.direction(v)) });
    return things;
  }

  // Whether what is held at a pixel moves, by drag() and drop(), instead of the globe.
  grab() {
    return false;
  }

  doubleClick(x, y, isBack) {
    this.camera.zoomAt(isBack ? 0.5 : 2, x, y);
    this.redraw();
  }

  // What is below the mouse.
  point(at) {
    const place = at === null ? null : this.camera.placeAt(at.x, at.y);
    this.scene.pointed = place === null ? [] : this.outlines({ site: this.finder.nearest(place), face: none }, 6);
    this.page.getElementById("place").textContent = place === null ? "" : placeText(lonLatOf(place), this.camera.zoom);
    this.redraw();
  }

  // The picture as a file. A canvas has its pixels until the next task only.
  save() {
    this.drawNow();
    this.element.toBlob((blob) => {
      const link = this.page.createElement("a");
      link.href = URL.createObjectURL(blob);
      link.download = "globe.png";
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
    });
  }
}
