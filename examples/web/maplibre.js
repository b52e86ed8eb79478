// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells of many sites, with isolines, on MapLibre's globe: maplibre.html?sites=1000000&projection=mercator

import * as maplibre from "maplibre-gl";
import { SphereLayer, SphereSites } from "rondel/maplibre";
import { makeField } from "./field.js";

const asked = new URLSearchParams(location.search);
const told = document.getElementById("told");

const map = new maplibre.Map({
  container: "map",
  center: [10, 50],
  zoom: 1,
  attributionControl: false,
  style: {
    version: 8,
    projection: { type: asked.get("projection") ?? "globe" },
    sources: {},
    layers: [{ id: "ground", type: "background", paint: { "background-color": "#26324a" } }],
  },
});

const field = makeField(Number(asked.get("sites") ?? 100000));
const opened = SphereSites.open(field);
await map.once("load");
const sites = await opened;

const cells = new SphereLayer({ id: "cells", sites, show: asked.get("show") ?? "cells", domain: [-1, 1] });
const lines = new SphereLayer({
  id: "lines",
  sites,
  show: "isolines",
  levels: [-0.5, 0, 0.5],
  lineColor: "#10151f",
  lineWidth: 2,
});
map.addLayer(cells);
map.addLayer(lines);
await Promise.all([cells.loaded, lines.loaded]);
told.textContent = `${sites.numSites} sites: click on one`;

map.on("click", async ({ lngLat }) => {
  const { site, value } = await sites.at(lngLat.lng, lngLat.lat);
  told.textContent = `site ${site}: ${value.toFixed(3)}`;
});

globalThis.example = { cells, field, lines, map, sites };
