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
/** @typedef {import("../surface/options.js").DrawnOptions} DrawnOptions */
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

/** The arguments of methods. @typedef {Record<string, readonly string[]>} Methods */

/** @type {Methods} */
const questions = {
  nearest: ["points"],
  kNearest: ["points", "k"],
  within: ["points", "angle"],
  locate: ["points"],
  free: [],
};
/** @type {Methods} */
const changes = { insert: ["sites"], remove: ["ids"], move: ["ids", "points"], moveAll: ["points"], ids: [], snapshot: [] };
/** @type {Methods} */
const drawing = { drawn: ["options"], nearest: ["lon", "lat"], free: [] };

/**
 * @typedef {object} Connection to a worker
 * @property {(message: any) => void} post
 * @property {(handle: (data: any) => void, fail: (reason: string) => void) => void} listen `fail` is called when there
 *   will be no answers, as where the worker does not load
 * @property {() => Promise<void>} stop
 */

/** A worker, in a browser or in Node.js. @returns {Promise<Connection>} */
async function spawn() {
  if (typeof Worker !== "undefined") {
    const worker = new Worker(new URL("./browser.js", import.meta.url), { type: "module" });
    return {
      post: (/** @type {any} */ message) => worker.postMessage(message),
      listen: (/** @type {(data: any) => void} */ handle, /** @type {(reason: string) => void} */ fail) => {
        worker.onmessage = (event) => handle(event.data);
        worker.onmessageerror = () => fail("an answer cannot be read");
        worker.onerror = (event) => fail(event.message || "it cannot be loaded"); // a file that is not there has no message
      },
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

/** Whether a worker can get a copy of a value. @param {unknown} value */
function canBeSent(value) {
  try {
    structuredClone(value);
    return true;
  } catch {
    return false;
  }
}

/** A worker and its pending requests. */
export class RondelWorker {
  #connection;
  #lastId = 0;
  #isStopped = false;
  /** Why there are no more answers. @type {Error | undefined} */
  #failure;
  /** The numbers of objects in the worker whose methods nothing refers to any more. @type {FinalizationRegistry<number>} */
  #forgotten = new FinalizationRegistry((object) => this.#release(object));
  /** @type {Map<number, {resolve: (value: any) => void, reject: (error: Error) => void}>} */
  #waiting = new Map();

  /** Use startWorker(). @param {Connection} connection */
  constructor(connection) {
    if (typeof connection?.listen !== "function") throw new TypeError("startWorker() makes workers, not this constructor");
    this.#connection = connection;
    connection.listen(
      ({ id, value, error }) => {
        const waiting = this.#waiting.get(id);
        this.#waiting.delete(id);
        if (error) waiting?.reject(revived(error));
        else waiting?.resolve(value);
      },
      (reason) => this.#fail(reason),
    );
  }

  /** Rejects all requests, unless the worker was told to end. @param {string} reason */
  #fail(reason) {
    if (this.#isStopped || this.#failure) return;
    this.#failure = new Error(`the worker failed: ${reason}`);
    for (const { reject } of this.#waiting.values()) reject(this.#failure);
    this.#waiting.clear();
  }

  /** Frees an object in the worker; nobody waits for the answer. @param {number} object */
  #release(object) {
    if (!this.#isStopped && !this.#failure) this.#connection.post({ id: ++this.#lastId, object, method: "free", args: [] });
  }

  /**
   * Posts a request. What cannot be copied to the worker is no argument of any method.
   * @param {number} object
   * @param {string} method
   * @param {readonly string[]} names of its arguments
   * @param {any[]} args
   * @returns {Promise<any>}
   */
  #ask(object, method, names, args) {
    if (this.#isStopped) throw new RondelError(`${method}() is used after the worker was stopped`, 0);
    if (this.#failure) throw this.#failure;
    return new Promise((resolve, reject) => {
      try {
        this.#connection.post({ id: ++this.#lastId, object, method, args: args.slice(0, names.length) });
        this.#waiting.set(this.#lastId, { resolve, reject });
      } catch {
        const bad = names.filter((_, i) => !canBeSent(args[i])).join(" and ");
        reject(new TypeError(`${bad}: functions, symbols and proxies cannot be copied to a worker`));
      }
    });
  }

  /** @param {any} result @param {Methods} methods */
  #remote({ object, ...result }, methods) {
    const held = { object }; // by each method: one that was taken out of the result keeps the object, too
    this.#forgotten.register(held, object, held);
    for (const [method, names] of Object.entries(methods)) {
      result[method] = async (/** @type {any[]} */ ...args) => {
        if (method === "free") this.#forgotten.unregister(held);
        const value = await this.#ask(held.object, method, names, args);
        return method === "snapshot" ? this.#remote(value, questions) : value;
      };
    }
    return result;
  }

  /** @param {Numbers} xyz @param {Options} [options] @returns {Promise<RemoteTriangulation>} */
  async delaunay(xyz, options = {}) {
    return this.#remote(await this.#ask(0, "delaunay", ["sites", "options"], [xyz, options]), questions);
  }

  /** @param {Numbers} xyz @param {Options} [options] @returns {Promise<RemoteDiagram>} */
  async voronoi(xyz, options = {}) {
    return this.#remote(await this.#ask(0, "voronoi", ["sites", "options"], [xyz, options]), questions);
  }

  /** @param {Numbers} [xyz] @param {Options} [options] @returns {Promise<RemoteDynamic>} */
  async dynamic(xyz = new Float64Array(), options = {}) {
    return this.#remote(await this.#ask(0, "dynamic", ["sites", "options"], [xyz, options]), { ...questions, ...changes });
  }

  /** @param {Places} places @returns {Promise<RemoteSites>} */
  async sites(places) {
    return this.#remote(await this.#ask(0, "sites", ["places"], [places]), drawing);
  }

  /** @param {any} object GeoJSON @param {TriangulateOptions} [options] @returns {Promise<Triangles>} */
  async triangulate(object, options = {}) {
    return this.#ask(0, "triangulate", ["object", "options"], [object, options]);
  }

  /** Ends the worker; pending requests are never answered, later ones are errors. */
  async stop() {
    this.#isStopped = true;
    await this.#connection.stop();
  }
}

/** @returns {Promise<RondelWorker>} */
export async function startWorker() {
  return new RondelWorker(await spawn());
}
