// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The chunks of a triangulation that changes: a site stays in its chunk until it moves, and the chunks in which nothing
// changed keep their buffers.

import { makeChunk, makeChunks } from "../../../viewer/src/chunks.js";

const mostGrowth = 2;  // of a chunk, before all are made again
const least = 300;  // sites of a chunk that may grow so far
const few = 5000;  // sites whose buffers are made at once, so that nothing flickers

function isListed(surface, site) {
  return surface.starOffsets[site] < surface.starOffsets[site + 1] || surface.isHidden(site);
}

// Whether a site has the same neighbors in the same order around it.
function hasSameStar(before, after, site) {
  const [a, b] = [before.starOffsets[site], after.starOffsets[site]];
  const count = before.starOffsets[site + 1] - a;
  if (after.starOffsets[site + 1] - b !== count) return false;
  if (count === 0) return true;
  let shift = 0;
  while (shift < count && after.starSites[b + shift] !== before.starSites[a]) ++shift;
  for (let j = 0; j < count; ++j) {
    if (before.starSites[a + j] !== after.starSites[b + ((shift + j) % count)]) return false;
  }
  return true;
}

function hasSamePlace(before, after, site) {
  for (let k = 3 * site; k < 3 * site + 3; ++k) {
    if (before.directions[k] !== after.directions[k]) return false;
  }
  return before.lengths === null || before.lengths[site] === after.lengths[site];
}

export class Groups {
  // `radii`: how far what is drawn of each site reaches beyond its faces and cell.
  constructor(surface, radii) {
    this.renew(surface, radii);
  }

  renew(surface, radii) {
    this.surface = surface;
    this.chunks = makeChunks(surface, radii);
    for (const chunk of this.chunks) chunk.isUrgent = surface.order.length <= few;
    this.members = this.chunks.map(({ begin, end }) => surface.order.slice(begin, end));
    this.largest = this.members.map((list) => mostGrowth * list.length);
    this.home = new Int32Array(surface.numSites).fill(-1);
    this.members.forEach((list, group) => list.forEach((site) => { this.home[site] = group; }));
  }

  // Another surface: its order and chunks. Returns the sites whose surroundings changed; null where all is new.
  follow(surface, radii) {
    const before = this.surface;
    const isSimple = (one) => one.dimension === 2 && one.isPlain;
    if (!isSimple(before) || !isSimple(surface) || this.chunks.length === 0) {
      this.renew(surface, radii);
      return null;
    }
    const changed = this.changedSites(before, surface);
    const touched = this.regroup(surface, changed);
    if (this.members.some((list, group) => list.length > this.largest[group] && list.length > least)) {
      this.renew(surface, radii);
      return null;
    }
    this.surface = surface;
    this.lay(surface, radii, touched);
    return changed;
  }

  changedSites(before, after) {
    const changed = new Set();
    const inBoth = Math.min(before.numSites, after.numSites);
    for (let site = 0; site < Math.max(before.numSites, after.numSites); ++site) {
      const isKnown = site < inBoth;
      const isSame = isKnown && hasSamePlace(before, after, site);
      if (isSame && hasSameStar(before, after, site) && before.isHidden(site) === after.isHidden(site)) continue;
      changed.add(site);
      if (!isSame && site < after.numSites) after.neighborsOf(site).forEach((neighbor) => changed.add(neighbor));
    }
    return changed;
  }

  // Brings changed sites to the chunk of a neighbor that stayed. Returns the chunks that differ now.
  regroup(surface, changed) {
    const touched = new Set();
    const { home } = this;
    if (home.length < surface.numSites) {
      this.home = new Int32Array(surface.numSites).fill(-1);
      this.home.set(home);
    }
    for (const site of changed) {
      const from = site < this.home.length ? this.home[site] : -1;
      const to = site < surface.numSites && isListed(surface, site) ? this.groupFor(surface, site, from) : -1;
      if (from >= 0) touched.add(from);
      if (to >= 0) touched.add(to);
      if (from === to) continue;
      if (from >= 0) this.members[from] = this.members[from].filter((member) => member !== site);
      if (to >= 0) this.members[to] = Uint32Array.of(...this.members[to], site);
      this.home[site] = to;
    }
    return touched;
  }

  // Where most neighbors are; a site stays where one of them is.
  groupFor(surface, site, from) {
    const corner = surface.isHidden(site) ? surface.corners(surface.faceAbove.get(site)) : surface.neighborsOf(site);
    const groups = corner.map((neighbor) => this.home[neighbor]).filter((group) => group >= 0);
    if (groups.includes(from)) return from;
    return groups[0] ?? Math.max(0, from);
  }

  lay(surface, radii, touched) {
    surface.order = new Uint32Array(this.members.reduce((sum, list) => sum + list.length, 0));
    let begin = 0;
    this.chunks = this.members.map((list, group) => {
      surface.order.set(list, begin);
      const end = begin + list.length;
      const chunk = touched.has(group) && list.length > 0
        ? { ...makeChunk(surface, radii, begin, end), isUrgent: true }
        : { ...this.chunks[group], begin, end };
      if (list.length === 0) delete chunk.parts;
      begin = end;
      return chunk;
    });
  }
}
