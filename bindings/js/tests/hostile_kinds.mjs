// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The kinds of the parameters of this package.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { and, called, callback, choice, count, flat, list, malformed, optional, options, real } from "./hostile_values.mjs";
import { thing, wrong } from "./hostile_values.mjs";

export const folder = dirname(createRequire(import.meta.url).resolve("rondel/package.json"));

export const octahedron = [1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1];
export const places = { lon: [0, 90, 180, -90, 0, 0], lat: [0, 0, 0, 0, 90, -90] };
export const pairs = places.lon.map((lon, i) => [lon, places.lat[i]]);
export const six = [0, 1, 2, 3, 4, 5];
export const square = { type: "Polygon", coordinates: [[[0, 0], [0, 10], [10, 10], [10, 0], [0, 0]]] };

// Triangulations.
export const sites = called("site sites", flat(octahedron, { width: 3 }));
export const point = called("point query", flat([0, 0, 1], { width: 3 }));
export const points = called("point points query site", flat([1, 2, 3, 4, 5, 6], { width: 3 }));
export const sixPoints = called("points site sites", { ...sites, bad: sites.bad.filter(({ index }) => !(index >= 5)) });
export const lonLat = called("longitude longitudes latitude latitudes", flat([0, 10, 20, 30], { width: 2 }));
export const radii = called("radius radii", flat([5, 6], { more: [[5], [1, 2, 3], [-1, 1], [1, 90], []] }));
const otherLengths = [[], [0], [0, 0], [0, 0, 0, 0], [0, 0, 0, 0, 0, 0, 0], Float64Array.of(0, 0)];
const sphere = {
  model: choice("weighted"),
  center: optional(flat([0, 0, 0], { width: 3, more: otherLengths })),
  squaredRadius: optional(called("squaredRadius squared", real(1, [0, -1, NaN, Infinity, -Infinity]))),
};
export const sphereOptions = optional(called("options", options(sphere)));
const circlesProjected = { value: { radii: [5, 6], model: "projected" }, index: 0, words: ["model"] };
const circles = options({ model: sphere.model, radii: optional(radii) });
export const lonLatOptions = optional(called("options", and(circles, circlesProjected)));
export const ids = called("ids site", list([1, 2], [[1, 1], [2 ** 31]]));
export const movedIds = called("ids site sites", list([1, 2], [[1, 2 ** 31], [1], []]));
export const id = called("id site", count(1, [6]));
export const site = called("site", count(1, [6]));
export const k = called("k", count(2));
export const angle = called("angle", real(1, [-1, NaN, -Infinity]));
const emptyModule = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0);
const shared = new SharedArrayBuffer(8);
const modules = (other) => [new Uint8Array(8), emptyModule, shared, new Uint8Array(shared), readFileSync(join(folder, other)), [], {}];
export const source = (other) => optional(called("source", thing(undefined, wrong(modules(other)))));

// Surfaces and layers.
const longitudes = called("lon longitude longitudes", flat(places.lon, { more: [[], [0]] }));
const latitudes = called("lat latitude latitudes", flat(places.lat, { more: [[], [0], [0, 0, 0, 0, 0, 91]] }));
export const lon = called("lon longitude", real(80, [NaN, Infinity]));
export const lat = called("lat latitude", real(20, [NaN, Infinity, 91, -91]));
export const placesKind = called("places lon lat", options({ lon: longitudes, lat: latitudes }, { isOpen: true }));
const inPlaces = (option) => ({ value: { ...places, ...option }, words: Object.keys(option) });
export const misplaced = [{ show: "triangles" }, { spacing: 1 }, { levels: [1] }].map(inPlaces);
export const values = called("values", flat(six, { isFinite: false, more: [[], [1], Float64Array.of(1, 2, 3)] }));
export const sitesOptions = called("options", options({ lon: longitudes, lat: latitudes, values: optional(values) }));
export const coarse = optional(real(10, [-1, NaN, Infinity, -Infinity]));
export const spacing = and(coarse, { value: 1e-9, index: 0 }, { value: 1e-300, index: 0 });
const levels = optional(flat([1, 2]));
const drawn = { show: choice("isolines"), spacing, levels };
const lacking = [
  { value: { show: "isolines", values: six }, words: ["levels"] },
  { value: { show: "isolines", levels: [1] }, words: ["values"] },
];
const ofLines = options({ ...drawn, values: optional(values) });
const ofCells = options({ spacing, levels, values: optional(values) }, { needed: { show: "cells" } });
export const drawnOptions = optional(called("options", and(ofLines, ...lacking, ...ofCells.bad)));
// The worker finds a spacing that is too fine.
export const sitesDrawn = optional(called("options", options({ ...drawn, spacing: coarse })));

const noColors = [[], [1, 2], [1, 2, 256], [1, 2, NaN], ["1", 2, 3], [1, 2, 3, 4, 5], "red", "#12345", "#gggggg", null, 7, {}];
const colors = ["#000000", [255, 255, 255]];
/** The kinds of the options of layers. @param {any} sphereSites @param {any[]} noSites */
export const layerParts = (sphereSites, noSites) => ({
  ...{ ...drawn, spacing: coarse },
  sites: thing(sphereSites, wrong([{}, ...noSites])),
  colors: optional(thing(colors, [...wrong([[]], 0), ...noColors.map((bad) => ({ value: ["#000000", bad], index: 1 }))])),
  domain: optional(flat([0, 5], { more: [[], [1], [1, 2, 3]] })),
  lineColor: { good: "#000000", bad: wrong(noColors, 0) },
  lineWidth: optional(real(1, [-1, NaN, Infinity])),
  opacity: optional(real(1, [-1, 2, NaN])),
});

// Polygons.
const inCollection = (object) => ({ type: "FeatureCollection", features: [square, object] });
const rings = [[[0, 0]], [[0, 0], [1, 1], [0, 0]], [[0, 0], [2, 2], [2, 0], [0, 2], [0, 0]], []];
const beyond = [[1, NaN], [Infinity, 1], [1, 91]].map((bad) => [[0, 0], bad, [2, 2], [0, 0]]);
const badFeatures = [...malformed, ...[...rings, ...beyond].map((ring) => ({ type: "Polygon", coordinates: [ring] }))];
const inGeometries = { type: "GeometryCollection", geometries: [square, { type: "Feature", geometry: square }] };
const noFeatures = [null, undefined, 5, "x", [], { type: "FeatureCollection", features: [] }, inGeometries];
export const geoJson = called(
  "object feature features polygon",
  thing(inCollection(square), [
    ...wrong([[square], { type: "FeatureCollection" }, { type: "FeatureCollection", features: square }]),
    ...wrong(badFeatures, 0),
    ...wrong([...badFeatures, ...noFeatures].map(inCollection), 1),
  ]),
);
const reading = { edges: choice("geodesic"), invalid: choice("error") };
export const triangulateOptions = optional(called("options", options({ ...reading, spacing })));
export const geoTriangulateOptions = optional(called("options", options({ spacing })));

// What d3-geo-voronoi has.
const noPlaces = [
  ...[null, undefined, "10,10", 5, () => 0],
  ...["1", true, 1n, {}, [1], Symbol("s"), new Number(1)].flatMap((part) => [[part, 1], [1, part]]),
].map((bad) => ({ value: [[0, 0], bad], index: 1 }));
const flatPlaces = { value: [0, 0, 10, 10], index: 0 };
const noArrays = wrong([{ length: 1, 0: [0, 0] }, Float64Array.of(0, 0)]);
export const geoPoints = called("point points", thing(pairs, [...noArrays, flatPlaces, ...noPlaces]));
export const data = called(
  "data datum",
  thing(pairs, [
    ...[flatPlaces, ...noPlaces],
    ...wrong([...malformed, { lon: 1, lat: 2 }].map((object) => [[0, 0], object]), 1),
    ...[{ value: { type: "FeatureCollection" } }, { value: inCollection({ type: "Circle" }), index: 1 }],
  ]),
);
// Without data, null or undefined, methods return false.
data.bad = data.bad.filter(({ value }) => value !== undefined && value !== null);
const noValues = ["1", null, undefined, NaN, Infinity, 1n, true, {}];
export const withValues = called(
  "data datum point",
  thing(pairs.map((place, i) => [...place, i]), [
    ...noPlaces.map(({ value, index }) => ({ value: value.map((p) => (Array.isArray(p) ? [...p, 1] : p)), index })),
    ...wrong(noValues.map((bad) => [[0, 0, 1], [1, 1, bad]]), 1),
  ]),
);
export const threshold = called("threshold", real(2, [NaN, Infinity]));
const levelsOrNumber = optional(flat([1, 2]));
levelsOrNumber.bad = levelsOrNumber.bad.filter(({ value }) => value !== 7);
export const thresholds = called("thresholds", and(levelsOrNumber, ...wrong([0, -1, NaN, Infinity, 1e300], 0)));
/** @param {number} n */
export const distances = (n) => called("distances", flat([...Array(n).keys()], { isFinite: false, more: [[], [1]] }));
export const lonAnywhere = called("lon", real(1, []));
export const latAnywhere = called("lat", real(1, []));
export const next = optional(called("next", count(1)));
export const radius = optional(called("radius", real(1, [NaN, -1, Infinity])));
/** @param {string} name @param {Function} good */
export const accessor = (name, good) => optional(called(name, callback(good)));
