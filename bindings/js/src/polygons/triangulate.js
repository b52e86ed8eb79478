// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangles that fill polygons of GeoJSON.

import { named, number, oneOf } from "../arguments.js";
import { engine } from "./engine.js";
import { RondelError } from "../errors.js";
import { flatPolygons } from "./geojson.js";

/** @typedef {import("../instance.js").Engine} Engine */

/**
 * Triangles that fill polygons: `points` are x, y, z of unit vectors; `triangles` three positions in points each,
 * counterclockwise seen from outside; feature f has the triangles offsets[f] ... offsets[f + 1] - 1.
 * @typedef {{points: Float64Array, triangles: Uint32Array, offsets: Uint32Array}} Triangles
 */

/**
 * @typedef {object} TriangulateOptions
 * @property {"lonlat" | "geodesic"} [edges] what joins positions: straight lines in longitude and latitude (the default,
 *   RFC 7946), which become arcs within 0.0001 degrees, or the shorter arcs of great circles
 * @property {"error" | "repair"} [invalid] what becomes of features that are not valid: an error (the default), or they
 *   get the places that an odd number of their rings' sides divides from the outside
 * @property {number} [spacing] degrees: longer sides are divided, and the inside gets points about that far from each
 *   other, so that triangles follow the globe; default 0, no points are added
 */

/**
 * Offsets of 64 bits, as the module reads them.
 * @param {readonly number[]} values
 */
export function wideOffsets(values) {
  const words = new Uint32Array(2 * values.length);
  values.forEach((value, i) => (words[2 * i] = value));
  return words;
}

/**
 * Makes an object of the module by make(scope), calls use(place), and frees it by the function `free`.
 * @template T
 * @param {Engine} owner
 * @param {string} free
 * @param {(scope: any) => number} make
 * @param {(place: number) => T} use
 * @returns {T}
 */
export function withMade(owner, free, make, use) {
  const place = owner.scoped(make);
  try {
    return use(place);
  } finally {
    owner.functions[free](place);
  }
}

/**
 * @param {Engine} owner
 * @param {number} polygons the place of a rondel_polygons
 * @param {number} n how many there are
 * @param {number} spacing
 * @returns {Triangles}
 */
export function trianglesOf(owner, polygons, n, spacing) {
  return withMade(
    owner,
    "rondel_triangles_free",
    (scope) => scope.made("rondel_triangulate_polygons", polygons, number(spacing, "spacing", 0), 0),
    (made) => {
      const { functions } = owner;
      const offsets = owner.offsets(functions.rondel_triangle_offsets(made), n + 1);
      return {
        points: owner.doubles(functions.rondel_triangle_points(made), 3 * functions.rondel_num_triangle_points(made)),
        triangles: owner.indices(functions.rondel_triangle_corners(made), 3 * offsets[n]),
        offsets,
      };
    },
  );
}

const edgeKinds = ["lonlat", "geodesic"];
const remedies = ["error", "repair"];

/**
 * Writes a rondel_reading.
 * @param {Engine} owner
 * @param {any} scope
 * @param {TriangulateOptions} options
 */
function placeReading(owner, scope, { edges = "lonlat", invalid = "error" }) {
  const kinds = [edgeKinds.indexOf(oneOf(edges, edgeKinds, "edges")), remedies.indexOf(oneOf(invalid, remedies, "invalid"))];
  const place = scope.room(3, 8);
  owner.functions.rondel_reading_init(place);
  new Int32Array(owner.memory.buffer, place + 4, 2).set(kinds);
  return place;
}

/**
 * Triangulates the inside of polygons of GeoJSON, exactly and never outside of them: a constrained Delaunay triangulation
 * on the sphere, in which their sides are edges. Polygons may be around poles, cross the antimeridian (or be cut there,
 * RFC 7946), and have holes; those that share sides have the same edges there. Points and lines have no inside.
 * @param {any} object a Polygon, MultiPolygon, GeometryCollection, Feature or FeatureCollection
 * @param {TriangulateOptions} [options]
 * @returns {Triangles} with a row of offsets for each feature of a FeatureCollection, one for any other object
 * @throws {RondelError} with the index of a feature that is not valid
 * @throws {TypeError} if this is no object, or an option does not exist
 */
export function triangulate(object, options = {}) {
  const { spacing = 0, ...reading } = named(options, ["edges", "invalid", "spacing"]);
  const owner = engine();
  const { features, polygons, rings, lonLat, isSphere } = flatPolygons(object);
  const sphere = isSphere.indexOf(true);
  if (sphere >= 0) throw new RondelError(`feature ${sphere}: a Sphere is none of RFC 7946; geoTriangulate takes it`, sphere);
  const n = features.length - 1;
  return withMade(
    owner,
    "rondel_features_free",
    (scope) =>
      scope.made(
        "rondel_features_create",
        scope.copy(wideOffsets(features)),
        n,
        scope.copy(wideOffsets(polygons)),
        scope.copy(wideOffsets(rings)),
        scope.copy(lonLat),
      ),
    (made) =>
      withMade(
        owner,
        "rondel_polygons_free",
        (scope) => scope.made("rondel_polygons_of_features", made, placeReading(owner, scope, reading), 0),
        (arcs) => trianglesOf(owner, arcs, n, spacing),
      ),
  );
}
