// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The page to play: sites are dragged, added and removed, and the worker's triangulation follows.

import { areaText, digits } from "../../../viewer/src/numbers.js";
import { none } from "../../../viewer/src/surface.js";
import { angleBetween, lengthOf, lonLatOf, minus, plus, times } from "../../../viewer/src/vectors.js";
import { Files } from "./files.js";
import { History } from "./history.js";
import { LiveGlobe } from "./live.js";

const smallestRadius = 0.005;  // radians, of circles that keys make
const largestRadius = 1.4;
const reach = { mouse: 12, other: 26 };  // pixels from a site at which it is grabbed

export class Play extends LiveGlobe {
  // `state` is that of no sites.
  constructor(page, state, coast, remote) {
    super(page, state, coast);
    this.remote = remote;
    this.points = [];  // what the worker will have when it has done all that it was asked
    this.history = new History();
    this.tool = "move";
    this.held = null;
    this.isHeldByKeys = false;
    this.isRelaxing = false;
    this.actions = {
      a: () => this.insertAt(this.camera.width / 2, this.camera.height / 2),
      Delete: () => this.removeChosen(),
      Backspace: () => this.removeChosen(),
      Enter: () => this.holdByKeys(),
      " ": () => this.holdByKeys(),
      "]": () => this.resizeChosen(1.1),
      "[": () => this.resizeChosen(1 / 1.1),
      Escape: () => this.escape(),
    };
    this.bindControls();
    this.files = new Files(page, this);
  }

  bindControls() {
    const on = (id, action) => this.panel.byId(id).addEventListener("click", action);
    for (const tool of ["move", "add", "remove"]) on(`tool-${tool}`, () => this.setTool(tool));
    on("undo", () => this.undo());
    on("redo", () => this.redo());
    on("relax", () => this.setRelaxing(!this.isRelaxing));
    this.page.addEventListener("keydown", (event) => this.shortcut(event));
    this.setTool("move");
    this.showHistory();
  }

  shortcut(event) {
    if (!(event.ctrlKey || event.metaKey) || event.target.matches?.("input, select")) return;
    const key = event.key.toLowerCase();
    if (key !== "z" && key !== "y") return;
    event.preventDefault();
    if (key === "y" || event.shiftKey) this.redo();
    else this.undo();
  }

  setTool(name) {
    this.tool = name;
    for (const tool of ["move", "add", "remove"]) {
      this.panel.byId(`tool-${tool}`).setAttribute("aria-pressed", String(tool === name));
    }
    this.element.dataset.tool = name;
  }

  // What the worker answered.
  show(state, method) {
    if (state.points) this.points = state.points;
    if (method === "load") {
      this.replace(state);
      this.lookAtSites();
      this.page.documentElement.dataset.state = "ready";
    } else {
      this.follow(state);
    }
    this.times = state.times;
    this.tell();
    if (this.coming !== undefined && this.isThere(this.coming)) {
      this.choose({ site: this.coming, face: none, place: null });
      this.coming = undefined;
    }
    if (this.pointer) this.point(this.pointer);
    if (method === "relax") {
      this.relaxed.after = this.points;
      requestAnimationFrame(() => this.isRelaxing && this.remote.ask("relax"));
    }
    if (this.remote.isIdle && this.held === null) this.rest();
  }

  // Whether the screen shows all that was done.
  get isSettled() {
    return this.remote.isIdle && this.isDrawn;
  }

  tell() {
    const { about, times: spent } = this;
    const byId = (id) => this.panel.byId(id);
    byId("stat-sum").textContent = about.sites === 0 ? "\u2013" : (about.areaSum / (4 * Math.PI)).toFixed(12);
    byId("stat-change").textContent = `${digits(spent.change, 2)} ms`;
    byId("stat-diagram").textContent = `${digits(spent.diagram, 2)} ms`;
  }

  fail({ message }, method) {
    this.setRelaxing(false);
    if (method === "load") this.history.past.pop();
    this.showHistory();
    this.warn(message);
  }

  warn(message) {
    const element = this.panel.byId("failure");
    element.textContent = message;
    element.hidden = false;
    clearTimeout(this.warning);
    this.warning = setTimeout(() => { element.hidden = true; }, 8000);
  }

  // The first sites. `table` as presets make it.
  begin(table) {
    this.remote.ask("load", { table, model: table.radii ? "weighted" : "projected" });
  }

  // Other sites, as something that can be undone.
  start(table) {
    this.setRelaxing(false);
    const before = [...this.points];
    const model = table.radii ? "weighted" : "projected";
    const oldModel = this.about.model;
    this.remote.ask("load", { table, model });
    this.remember(
      () => this.remote.ask("load", { sites: before, model: oldModel }), () => this.remote.ask("load", { table, model }));
  }

  remember(undo, redo) {
    this.history.add({ undo, redo });
    this.panel.byId("hint").hidden = true;
    this.showHistory();
  }

  showHistory() {
    this.panel.byId("undo").disabled = this.history.past.length === 0;
    this.panel.byId("redo").disabled = this.history.future.length === 0;
  }

  undo() {
    this.setRelaxing(false);
    this.release();
    this.history.back();
    this.showHistory();
  }

  redo() {
    this.setRelaxing(false);
    this.release();
    this.history.forth();
    this.showHistory();
  }

  // Sites that are all in one region fill the picture.
  lookAtSites() {
    const there = this.points.filter((point) => point !== null).map((point) => times(point, 1 / lengthOf(point)));
    const sum = there.reduce(plus, [0, 0, 0]);
    const isAround = there.length === 0 || lengthOf(sum) <= 0.75 * there.length;
    const [view, closeness] = [this.about.view, this.about.closeness];
    this.about.view = isAround ? [10, 25] : lonLatOf(sum);
    const middle = times(sum, 1 / lengthOf(sum));
    const farthest = isAround ? 1 : there.reduce((most, p) => Math.max(most, lengthOf(minus(p, middle))), 0);
    this.about.closeness = Math.max(1, 0.9 / Math.max(farthest, 1e-11));
    const isSame = closeness === this.about.closeness && view.every((x, i) => x === this.about.view[i]);
    if (!isSame) this.home();
  }

  // The site to which a pixel belongs, so near that it can be told from its neighbors; `none` without one.
  siteAt(x, y, kind) {
    const place = this.camera.placeAt(x, y);
    if (place === null) return none;
    const { surface, finder, camera } = this;
    const nearest = finder.nearest(place);
    if (nearest === none) return none;
    const neighbors = surface.neighborsOf(nearest);
    const distance = (site) => {
      const at = camera.pixelOf(surface.direction(site));
      return at.isFront ? Math.hypot(at.x - x, at.y - y) : Infinity;
    };
    let best = none;
    let least = Infinity;
    for (const site of [nearest, ...neighbors, ...surface.faceAbove.keys()]) {
      if (distance(site) < least) [best, least] = [site, distance(site)];
    }
    const between = neighbors.map((site) => angleBetween(surface.direction(nearest), surface.direction(site)));
    const limit = Math.max(3, 0.4 * camera.zoom * Math.min(Math.PI, ...between));
    return least <= Math.min(limit, reach[kind] ?? reach.other) ? best : none;
  }

  grab(at, kind) {
    this.kind = kind;
    this.release();
    if (this.tool !== "move" || this.isRelaxing) return false;
    const site = this.siteAt(at.x, at.y, kind);
    if (site === none) return false;
    const { x, y } = this.camera.pixelOf(this.surface.direction(site));
    this.held = { site, from: this.points[site], offset: { x: x - at.x, y: y - at.y } };
    return true;
  }

  drag(at) {
    const { offset } = this.held;
    this.pointer = at;
    this.pull(this.camera.placeAt(at.x + offset.x, at.y + offset.y, true));
  }

  // The site that is held goes to a place, a unit vector.
  pull(place) {
    const { site } = this.held;
    const point = times(place, lengthOf(this.held.from));
    this.points[site] = this.held.to = point;
    this.remote.change({ what: "move", key: site, point });
    if (this.picked?.site !== site || this.picked.place !== null) this.choose({ site, face: none, place: null });
  }

  drop() {
    const { site, from, to } = this.held;
    this.held = null;
    if (to === undefined) return;
    this.remember(() => this.set("move", site, from), () => this.set("move", site, to));
    if (this.remote.isIdle) this.rest();
  }

  // Lets go what the keys hold.
  release() {
    if (!this.isHeldByKeys) return;
    this.isHeldByKeys = false;
    this.drop();
    this.panel.byId("status").textContent = "Put down";
  }

  set(what, key, point = null) {
    this.points[key] = point;
    this.remote.change({ what, key, point });
  }

  insert(place) {
    const key = this.points.length;
    const isWeighted = this.about.model === "weighted";
    const length = isWeighted ? 1 / Math.cos(Math.min(0.5, Math.sqrt(2 / (1 + this.about.sites)))) : 1;
    const point = times(place, length);
    this.set("insert", key, point);
    this.remember(() => this.set("remove", key), () => this.set("insert", key, point));
    this.coming = key;
  }

  insertAt(x, y) {
    const place = this.camera.placeAt(x, y);
    if (place !== null && !this.isRelaxing) this.insert(place);
  }

  remove(site) {
    if (this.isRelaxing) return;
    const point = this.points[site];
    this.choose(null);
    this.set("remove", site);
    this.remember(() => this.set("insert", site, point), () => this.set("remove", site));
  }

  removeChosen() {
    this.release();
    const site = this.picked?.site ?? none;
    if (site !== none && this.points[site]) this.remove(site);
  }

  // A circle becomes larger or smaller, by a factor.
  resizeChosen(factor) {
    const site = this.picked?.site ?? none;
    if (this.about.model !== "weighted" || site === none || !this.points[site]) return;
    const from = this.points[site];
    const radius = Math.min(largestRadius, Math.max(smallestRadius, factor * Math.acos(Math.min(1, 1 / lengthOf(from)))));
    const to = times(from, 1 / lengthOf(from) / Math.cos(radius));
    this.set("move", site, to);
    this.remember(() => this.set("move", site, from), () => this.set("move", site, to));
  }

  click(x, y) {
    const site = this.siteAt(x, y, this.kind);
    if (this.tool === "add") this.insertAt(x, y);
    else if (this.tool === "remove" && site !== none) this.remove(site);
    else if (site !== none) this.choose({ site, face: none, place: null });
    else super.click(x, y);
  }

  // Adds a site, or removes the one that is there.
  doubleClick(x, y) {
    if (this.tool !== "move") {
      this.click(x, y);
      return;
    }
    const site = this.siteAt(x, y, this.kind);
    if (site === none) this.insertAt(x, y);
    else this.remove(site);
  }

  // The site nearest to the middle comes along while the globe is turned, until the key is pressed again.
  holdByKeys() {
    if (this.isHeldByKeys) {
      this.release();
      return;
    }
    const site = this.finder.nearest(this.camera.forward);
    if (site === none || this.isRelaxing) return;
    this.goTo(site);
    this.held = { site, from: this.points[site] };
    this.isHeldByKeys = true;
    this.panel.byId("status").textContent = `Site ${site} is held: arrow keys move it, Enter puts it down`;
  }

  escape() {
    this.release();
    this.setTool("move");
    this.choose(null);
  }

  step(time) {
    const isComing = Boolean(this.motion);
    super.step(time);
    const { forward } = this.camera;
    if (this.isHeldByKeys && !isComing && forward !== this.lastForward) this.pull(forward);
    this.lastForward = forward;
  }

  setRelaxing(isRelaxing) {
    if (this.isRelaxing === isRelaxing) return;
    this.release();
    this.isRelaxing = isRelaxing;
    this.panel.byId("relax").setAttribute("aria-pressed", String(isRelaxing));
    if (!isRelaxing) return;
    const { model } = this.about;
    const relaxed = { before: [...this.points], after: null };
    this.relaxed = relaxed;
    this.remember(
      () => this.remote.ask("load", { sites: relaxed.before, model }),
      () => this.remote.ask("load", { sites: relaxed.after ?? relaxed.before, model }));
    this.remote.ask("relax");
  }

  // The site, cell and empty circles below the pointer.
  point(at) {
    this.pointer = at;
    super.point(at);
    const place = at === null ? null : this.camera.placeAt(at.x, at.y);
    const site = place === null ? none : this.finder.nearest(place);
    this.panel.byId("stat-cell").textContent = site === none ? "\u2013" : areaText(this.surface.areas[site]);
    this.element.dataset.over = String(at !== null && this.siteAt(at.x, at.y, "mouse") !== none);
    this.scene.circled = site === none ? [] : this.circlesAt(site);
  }
}
