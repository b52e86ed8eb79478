// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A row for all that is public: how it is called, with parameters of which kinds, or why it needs no wrong arguments.

import * as deck from "rondel/deck";
import * as maplibre from "rondel/maplibre";
import * as polygons from "rondel/polygons";
import * as rondel from "rondel";
import * as surfaces from "rondel/surface";
import * as workers from "rondel/worker";
import * as of from "./hostile_kinds.mjs";
import { and, called, options, thing, wrong } from "./hostile_values.mjs";

const { octahedron, pairs, places, square } = of;

/**
 * A row: a call, the kinds of its arguments, and a state that wrong calls leave as it was. Calls without a state of their
 * own are pure: the state is what the right arguments give.
 */
function row(call, kinds, state) {
  const good = kinds.map((kind) => kind.good);
  return { call, kinds, isPure: !state, state: state ?? (() => call(...good)) };
}
const host = "the map calls it";
export const notPublic = "it is protected in the types";
export const reader = "it is read";
const noArguments = "it takes no arguments";

const fixed = rondel.voronoi(octahedron);
const dynamic = new rondel.DynamicTriangulation(octahedron);
const drawnSites = new surfaces.DrawnSites(places);
const mesh = surfaces.surface(places);
const sphereSites = await maplibre.SphereSites.open({ ...places, values: of.six });
const layer = new maplibre.SphereLayer({ id: "cells", sites: sphereSites });
await layer.loaded;
const worker = await workers.startWorker();
const remote = {
  delaunay: await worker.delaunay(octahedron),
  voronoi: await worker.voronoi(octahedron),
  dynamic: await worker.dynamic(octahedron),
  sites: await worker.sites(places),
};
const geo = { delaunay: rondel.geoDelaunay(pairs), voronoi: rondel.geoVoronoi(), contour: rondel.geoContour() };

/** Ends the workers. */
export const end = () => Promise.all([worker.stop(), sphereSites.close()]);

/** Objects that functions make, whose own functions are public, too. */
export const made = {
  "geoDelaunay()": geo.delaunay,
  "geoVoronoi()": geo.voronoi,
  "geoContour()": geo.contour,
  ...Object.fromEntries(Object.entries(remote).map(([name, object]) => [`remote.${name}()`, object])),
};

const named = (names, rowOf) => Object.fromEntries(names.map((name) => [name, rowOf(name)]));
const members = (path, rows) =>
  Object.fromEntries(Reflect.ownKeys(rows).map((name) => [`${path}#${String(name)}`, rows[name]]));
const inside = (path, rows) => Object.fromEntries(Object.keys(rows).map((name) => [`${path}.${name}`, rows[name]]));
const read = (...names) => named(names, () => reader);
const calledByHost = (...names) => named(names, () => host);

/** A constructor that is not for users; its message names what is. */
function madeBy(word, Type) {
  const anything = called(word, thing(undefined, wrong([{}, []])));
  return row((value) => new Type(value, 1), [anything], () => fixed.numSites);
}

const questions = (target, state) => ({
  nearest: row((p) => target.nearest(p), [of.points], state),
  kNearest: row((p, n) => target.kNearest(p, n), [of.points, of.k], state),
  within: row((p, a) => target.within(p, a), [of.points, of.angle], state),
  locate: row((p) => target.locate(p), [of.points], state),
});
const changes = (target, state) => ({
  insert: row((p) => target.insert(p), [of.sites], state),
  remove: row((ids) => target.remove(ids), [of.ids], state),
  move: row((ids, p) => target.move(ids, p), [of.movedIds, of.points], state),
  moveAll: row((p) => target.moveAll(p), [of.sixPoints], state),
});
const located = (target, state) => ({
  ...questions(target, state),
  distance: row((p, s) => target.distance(p, s), [of.point, of.site], state),
  ...{ makeLocator: notPublic, freeLocator: notPublic, free: noArguments },
  [Symbol.dispose ?? Symbol.for("Symbol.dispose")]: noArguments,
});
const triangulation = {
  ...located(fixed),
  once: notPublic,
  ...read("dimension", "model", "numSites", "numVertices", "numFaces", "points", "triangles", "neighbors", "ghostFaces"),
  ...read("ring", "duplicates", "hidden", "edges", "centers", "centroids"),
};
const dynamicState = () => [dynamic.ids, dynamic.snapshot().triangles, dynamic.nearest([1, 2, 3])];
const remoteState = async () => [await remote.dynamic.ids(), (await remote.dynamic.snapshot()).triangles];
const startSites = { ...of.sites, bad: of.sites.bad.filter(({ value }) => value !== undefined) };

const core = {
  ...inside("rondel", { noIndex: "a number", RondelError: "an error" }),
  "rondel.init": row(rondel.init, [of.source("polygons.wasm")], () => rondel.unitVectors([1, 2])),
  "rondel.unitVectors": row(rondel.unitVectors, [of.lonLat]),
  "rondel.polarPoints": row(rondel.polarPoints, [of.lonLat, of.radii]),
  ...Object.assign({}, ...["delaunay", "voronoi"].map((name) => ({
    [`rondel.${name}`]: row((...all) => rondel[name](...all).triangles, [of.sites, of.sphereOptions]),
    [`rondel.${name}.lonLat`]: row((...all) => rondel[name].lonLat(...all).duplicates, [of.lonLat, of.lonLatOptions]),
  }))),
  "rondel.Triangulation": madeBy("delaunay", rondel.Triangulation),
  ...members("rondel.Triangulation", triangulation),
  "rondel.VoronoiDiagram": madeBy("delaunay", rondel.VoronoiDiagram),
  ...members("rondel.VoronoiDiagram", { ...triangulation, ...read("cells", "areas") }),
  "rondel.DynamicTriangulation": row((...all) => new rondel.DynamicTriangulation(...all).ids, [startSites, of.sphereOptions]),
  ...members("rondel.DynamicTriangulation", {
    ...{ ...located(dynamic, dynamicState), ...changes(dynamic, dynamicState) },
    ...{ ...read("numSites", "ids"), snapshot: noArguments },
    neighbors: row((id) => dynamic.neighbors(id), [of.id], dynamicState),
  }),
};

const setting = (make, name, good) => row((f) => make()[name](f) && 0, [of.accessor(name, good)]);
const diagrams = ["polygons", "triangles", "links", "mesh", "cellMesh", "hull"];
const settings = ["x", "y", "value", "triangulate", "pointInterpolate", "ringsort"];
const find = (...all) => geo.voronoi(pairs).find(...all);
const d3 = {
  "rondel.geoContour": noArguments,
  "rondel.geoDelaunay": row((p) => rondel.geoDelaunay(p).triangles, [of.geoPoints]),
  "rondel.geoVoronoi": row((d) => rondel.geoVoronoi(d).mesh(), [of.data]),
  "geoDelaunay().find": row(geo.delaunay.find, [of.lonAnywhere, of.latAnywhere, of.next]),
  "geoDelaunay().urquhart": row(geo.delaunay.urquhart, [of.distances(geo.delaunay.edges.length)]),
  "geoVoronoi()": row((d) => rondel.geoVoronoi()(d).points, [of.data]),
  ...inside("geoVoronoi()", named(diagrams, (name) => row((d) => rondel.geoVoronoi()[name](d), [of.data]))),
  ...inside("geoVoronoi()", named(["x", "y"], (name) => setting(rondel.geoVoronoi, name, (d) => d[0]))),
  "geoVoronoi().find": row(find, [of.lonAnywhere, of.latAnywhere, of.radius]),
  "geoContour()": row((d) => rondel.geoContour()(d), [of.withValues]),
  ...inside("geoContour()", named(settings, (name) => setting(rondel.geoContour, name, (d) => d))),
  "geoContour().thresholds": row((t) => rondel.geoContour().thresholds(t)(of.withValues.good), [of.thresholds]),
  "geoContour().contour": row((d, t) => rondel.geoContour().contour(d, t), [of.withValues, of.threshold]),
  "geoContour().contours": row((d) => [...rondel.geoContour().contours(d)], [of.withValues]),
  "geoContour().isobands": row((d) => [...rondel.geoContour().isobands(d)], [of.withValues]),
};

const noMeshes = [{}, places, surfaces.surface(places, { show: "cell-borders" })];
const surfaceRows = {
  "polygons.init": row(polygons.init, [of.source("rondel.wasm")], () => polygons.triangulate(square)),
  "polygons.triangulate": row(polygons.triangulate, [of.geoJson, of.triangulateOptions]),
  "polygons.geoTriangulate": row(polygons.geoTriangulate, [of.geoJson, of.geoTriangulateOptions]),
  "surface.surface": row(surfaces.surface, [and(of.placesKind, ...of.misplaced), of.drawnOptions]),
  "surface.vertexValues": row(surfaces.vertexValues, [called("mesh", thing(mesh, wrong(noMeshes))), of.values]),
  "surface.DrawnSites": row((p) => new surfaces.DrawnSites(p).nearest(80, 20), [of.placesKind]),
  ...members("surface.DrawnSites", {
    ...{ numSites: reader, free: noArguments, drawn: row((o) => drawnSites.drawn(o), [of.drawnOptions]) },
    nearest: row((...all) => drawnSites.nearest(...all), [of.lon, of.lat]),
  }),
};

async function opened(given) {
  const sites = await maplibre.SphereSites.open(given);
  await sites.close();
  return sites.values;
}

const parts = of.layerParts(sphereSites, [drawnSites, remote.sites]);
const { sites: _, ...changing } = parts;
const id = { good: "x", bad: wrong([undefined, null, 7, {}, Symbol("s")]) };
// Props that deck.gl does not know are fine there, null is none, and the opacity is its own.
const { opacity: __, ...propParts } = parts;
const isGiven = (value) => Object.keys(propParts).every((name) => name in value && value[name] !== null);
const isProp = ({ value, words }) => words && value.sites !== undefined && isGiven(value);
const props = { ...options(propParts), bad: options(propParts).bad.filter(isProp) };
const layers = {
  "maplibre.SphereSites": madeBy("open", maplibre.SphereSites),
  "maplibre.SphereSites.open": row(opened, [of.sitesOptions], () => sphereSites.values),
  ...members("maplibre.SphereSites", {
    ...{ ...read("numSites", "extent"), close: noArguments, drawn: row((o) => sphereSites.drawn(o), [of.sitesDrawn]) },
    setValues: row((v) => sphereSites.setValues(v), [of.values], () => [sphereSites.values, sphereSites.valuesChanged]),
    onChange: row((f) => sphereSites.onChange(f)(), [of.accessor("listener", () => 0)], () => sphereSites.values),
    at: row((...all) => sphereSites.at(...all), [of.lon, of.lat]),
  }),
  "maplibre.SphereLayer": row((o) => new maplibre.SphereLayer(o).id, [called("options", options({ ...parts, id }))]),
  ...members("maplibre.SphereLayer", {
    ...{ ...read("loaded"), ...calledByHost("onAdd", "onRemove", "render") },
    setOptions: row((o) => layer.setOptions(o), [called("options", options(changing))], () => layer.loaded),
  }),
  "deck.SphereLayer": row((o) => new deck.SphereLayer({ id: "x", ...o }).id, [called("sites", props)]),
  ...inside("deck.SphereLayer", { layerName: "a text", defaultProps: "an object" }),
  ...members("deck.SphereLayer", calledByHost("initializeState", "updateState", "draw", "getPickingInfo", "finalizeState")),
  ...members("deck.SphereLayer", read("isLoaded")),
};

const remoteRows = {
  "worker.startWorker": noArguments,
  "worker.RondelWorker": madeBy("startWorker", workers.RondelWorker),
  ...members("worker.RondelWorker", {
    stop: noArguments,
    delaunay: row(async (...all) => (await worker.delaunay(...all)).triangles, [of.sites, of.sphereOptions]),
    voronoi: row(async (...all) => (await worker.voronoi(...all)).triangles, [of.sites, of.sphereOptions]),
    dynamic: row(async (...all) => (await worker.dynamic(...all)).ids(), [startSites, of.sphereOptions]),
    sites: row(async (p) => (await worker.sites(p)).numSites, [of.placesKind]),
    triangulate: row((...all) => worker.triangulate(...all), [of.geoJson, of.triangulateOptions]),
  }),
  ...inside("remote.delaunay()", { ...questions(remote.delaunay), free: noArguments }),
  ...inside("remote.voronoi()", { ...questions(remote.voronoi), free: noArguments }),
  ...inside("remote.dynamic()", { ...questions(remote.dynamic, remoteState), ...changes(remote.dynamic, remoteState) }),
  ...inside("remote.dynamic()", { ids: noArguments, snapshot: noArguments, free: noArguments }),
  "remote.sites().free": noArguments,
  "remote.sites().drawn": row((o) => remote.sites.drawn(o), [of.drawnOptions]),
  "remote.sites().nearest": row((...all) => remote.sites.nearest(...all), [of.lon, of.lat]),
};

export const table = { ...core, ...d3, ...surfaceRows, ...layers, ...remoteRows };
