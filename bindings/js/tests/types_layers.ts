// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

import { Deck } from "@deck.gl/core";
import { Map } from "maplibre-gl";
import { SphereLayer as DeckLayer } from "rondel/deck";
import { SphereLayer, SphereSites, type Picked } from "rondel/maplibre";
import { surface, vertexValues, type Mesh } from "rondel/surface";

export async function layers(): Promise<[Picked | undefined, Float32Array]> {
  const sites: SphereSites = await SphereSites.open({ lon: [0, 90, 0], lat: [0, 0, 90], values: [1, 2, NaN] });
  const map = new Map({ container: "map" });
  const layer = new SphereLayer({ id: "cells", sites, show: "cells", colors: ["#000000", [255, 255, 255]], domain: [0, 1] });
  map.addLayer(layer);
  layer.setOptions({ opacity: 0.5, show: "isolines", levels: [0.5] });
  const picked: Picked | undefined = await sites.at(10, 20);
  new Deck({ layers: [new DeckLayer({ id: "cells", sites, show: "triangles", pickable: true })] });
  const mesh = surface({ lon: [0], lat: [0] }) as Mesh;
  const values: Float32Array = vertexValues(mesh, [1]);
  return [picked, values];
}
