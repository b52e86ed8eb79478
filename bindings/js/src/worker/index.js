// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/**
 * Rondel in its own worker, so that a page stays responsive while it computes. Results are plain objects with methods
 * that return promises; their arrays were moved here, not copied.
 *
 *     const rondel = await startWorker();
 *     const diagram = await rondel.voronoi(xyz);       // diagram.triangles, diagram.cells, diagram.areas ...
 *     const sites = await diagram.nearest(points);
 *     await diagram.free();
 *     await rondel.stop();
 * @module
 */

import { RondelError } from "../errors.js";

/** @typedef {import("../arguments.js").Numbers} Numbers */
/** @typedef {import("../arguments.js").Indices} Indices */
/** @typedef {import("../arguments.js").Options} Options */
/** @typedef {import("../triangulation.js").Cells} Cells */
/** @typedef {import("../located.js").SiteLists} SiteLists */
/** @typedef {import("../located.js").Locations} Locations */
/** @typedef {import("../surface/lines.js").Lines} Lines */
/** @typedef {import("../surface/meshes.js").Mesh} Mesh */
/** @typedef {import("../surface/sites.js").DrawnOptions} DrawnOptions */
/** @typedef {import("../surface/sites.js").Places} Places */
/** @typedef {import("../polygons/triangulate.js").Triangles} Triangles */
/** @typedef {import("../polygons/triangulate.js").TriangulateOptions} TriangulateOptions */

/**
 * @typedef {object} RemoteQuestions see Located
 * @property {(points: Numbers) => Promise<Uint32Array>} nearest
 * @property {(points: Numbers, k: number) => Promise<Uint32Array>} kNearest
 * @property {(points: Numbers, angle: number) => Promise<SiteLists>} within
 * @property {(points: Numbers) => Promise<Locations>} locate
 * @property {() => Promise<void>} free
 */

/**
 * @typedef {object} RemoteArrays see Triangulation
 * @property {number} dimension
 * @property {number} numSites
 * @property {number} numVertices
 * @property {number} numFaces
 * @property {Uint32Array} triangles
 * @property {Uint32Array} neighbors
 * @property {Uint32Array} ghostFaces
 * @property {Uint32Array} ring
 * @property {Uint32Array} duplicates
 * @property {Uint32Array} hidden
 */

/** @typedef {RemoteQuestions & RemoteArrays} RemoteTriangulation */
/** @typedef {RemoteTriangulation & {centers: Float64Array, cells: Cells, areas: Float64Array}} RemoteDiagram */

/**
 * @typedef {RemoteQuestions & {
 *   insert(xyz: Numbers): Promise<Uint32Array>,
 *   remove(ids: Indices): Promise<void>,
 *   move(ids: Indices, xyz: Numbers): Promise<void>,
 *   moveAll(xyz: Numbers): Promise<void>,
 *   ids(): Promise<Uint32Array>,
 *   snapshot(): Promise<RemoteDiagram>,
 * }} RemoteDynamic see DynamicTriangulation
 */

/**
 * @typedef {object} RemoteSites see DrawnSites
 * @property {number} numSites
 * @property {(options?: DrawnOptions) => Promise<Mesh | Lines>} drawn
 * @property {(lon: number, lat: number) => Promise<number>} nearest
 * @property {() => Promise<void>} free
 */

const questions = ["nearest", "kNearest", "within", "locate", "free"];
const changes = ["insert", "remove", "move", "moveAll", "ids", "snapshot"];

/**
 * @typedef {object} Connection to a worker
 * @property {(message: any) => void} post
 * @property {(handle: (data: any) => void) => void} listen
 * @property {() => Promise<void>} stop
 */

/** A worker, in a browser or in Node.js. @returns {Promise<Connection>} */
async function spawn() {
  if (typeof Worker !== "undefined") {
    const worker = new Worker(new URL("./browser.js", import.meta.url), { type: "module" });
    return {
      post: (/** @type {any} */ message) => worker.postMessage(message),
      listen: (/** @type {(data: any) => void} */ handle) => void (worker.onmessage = (event) => handle(event.data)),
      stop: async () => worker.terminate(),
    };
  }
  const { spawnThread } = await import("./threads.js"); // package.json keeps it out of bundles for browsers
  return spawnThread();
}

/** @param {{name: string, text: string, index: number}} error */
function revived({ name, text, index }) {
  if (name === "RondelError") return new RondelError(text, index);
  return name === "RangeError" ? new RangeError(text) : name === "TypeError" ? new TypeError(text) : new Error(text);
}

/** A worker and its pending requests. */
export class RondelWorker {
  #connection;
  #lastId = 0;
  /** @type {Map<number, {resolve: (value: any) => void, reject: (error: Error) => void}>} */
  #waiting = new Map();

  /** @param {Connection} connection */
  constructor(connection) {
    this.#connection = connection;
    connection.listen(({ id, value, error }) => {
      const { resolve, reject } = /** @type {any} */ (this.#waiting.get(id));
      this.#waiting.delete(id);
      if (error) reject(revived(error));
      else resolve(value);
    });
  }

  /** @param {number} object @param {string} method @param {any[]} args @returns {Promise<any>} */
  #ask(object, method, args) {
    return new Promise((resolve, reject) => {
      this.#waiting.set(++this.#lastId, { resolve, reject });
      this.#connection.post({ id: this.#lastId, object, method, args });
    });
  }

  /** @param {any} result @param {string[]} methods */
  #remote({ object, ...result }, methods) {
    for (const method of methods) {
      result[method] = async (/** @type {any[]} */ ...args) => {
        const value = await this.#ask(object, method, args);
        return method === "snapshot" ? this.#remote(value, questions) : value;
      };
    }
    return result;
  }

  /** @param {Numbers} xyz @param {Options} [options] @returns {Promise<RemoteTriangulation>} */
  async delaunay(xyz, options = {}) {
    return this.#remote(await this.#ask(0, "delaunay", [xyz, options]), questions);
  }

  /** @param {Numbers} xyz @param {Options} [options] @returns {Promise<RemoteDiagram>} */
  async voronoi(xyz, options = {}) {
    return this.#remote(await this.#ask(0, "voronoi", [xyz, options]), questions);
  }

  /** @param {Numbers} [xyz] @param {Options} [options] @returns {Promise<RemoteDynamic>} */
  async dynamic(xyz = new Float64Array(), options = {}) {
    return this.#remote(await this.#ask(0, "dynamic", [xyz, options]), [...questions, ...changes]);
  }

  /** @param {Places} places @returns {Promise<RemoteSites>} */
  async sites(places) {
    return this.#remote(await this.#ask(0, "sites", [places]), ["drawn", "nearest", "free"]);
  }

  /** @param {any} object GeoJSON @param {TriangulateOptions} [options] @returns {Promise<Triangles>} */
  async triangulate(object, options = {}) {
    return this.#ask(0, "triangulate", [object, options]);
  }

  /** Ends the worker; pending requests are never answered. */
  async stop() {
    await this.#connection.stop();
  }
}

/** @returns {Promise<RondelWorker>} */
export async function startWorker() {
  return new RondelWorker(await spawn());
}
