// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells of many sites on deck.gl's globe: deck.html?sites=1000000&view=map

import { Deck, _GlobeView as GlobeView, MapView } from "@deck.gl/core";
import { SphereLayer, SphereSites } from "rondel/deck";
import { makeField } from "./field.js";

const asked = new URLSearchParams(location.search);
const told = document.getElementById("told");

const field = makeField(Number(asked.get("sites") ?? 100000));
const sites = await SphereSites.open(field);

const cells = new SphereLayer({ id: "cells", sites, show: asked.get("show") ?? "cells", domain: [-1, 1], pickable: true });
const lines = new SphereLayer({
  id: "lines",
  sites,
  show: "isolines",
  levels: [-0.5, 0, 0.5],
  lineColor: "#10151f",
  lineWidth: 2,
});

const deck = new Deck({
  parent: document.getElementById("map"),
  views: asked.get("view") === "map" ? new MapView({ repeat: true }) : new GlobeView(),
  initialViewState: { longitude: 10, latitude: 50, zoom: 0.5 },
  controller: true,
  layers: [cells, lines],
  onClick: ({ object }) => {
    if (object) told.textContent = `site ${object.site}: ${object.value.toFixed(3)}`;
  },
  onAfterRender: () => {
    if (globalThis.example || !cells.isLoaded || !lines.isLoaded) return;
    told.textContent = `${sites.numSites} sites: click on one`;
    globalThis.example = { cells, deck, field, sites };
  },
});
