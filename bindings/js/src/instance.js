// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// <reference lib="esnext.disposable" preserve="true" />

// Loads modules of WebAssembly, manages their memory, and calls their functions, which are those of
// bindings/c/include/rondel.h.

import { shown } from "./arguments.js";
import { RondelError } from "./errors.js";

const pageSize = 65536;
const initialPages = 64; // as cmake/wasi.cmake links it
const mostPages = 65536; // 4 GiB

const invalidInput = 1; // values of rondel_status
const outOfMemory = 3;

/** @typedef {Float64Array | Uint32Array | Int32Array} Values */

/** @param {string} text base64 */
function decode(text) {
  if (typeof Buffer !== "undefined") return Buffer.from(text, "base64");
  return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
}

// The system functions that the C library imports: a clock, and output, which is discarded.
/** @param {() => DataView} view of the memory */
function systemFunctions(view) {
  const notSupported = () => 52; // ENOSYS of WASI
  return new Proxy(/** @type {Record<string, Function>} */ ({}), {
    get(_, name) {
      if (name !== "clock_time_get") return notSupported;
      return (/** @type {number} */ _clock, /** @type {bigint} */ _precision, /** @type {number} */ place) => {
        view().setBigUint64(place, BigInt(Math.round(performance.now() * 1e6)), true);
        return 0;
      };
    },
  });
}

/** One instance of a module. All functions of this package share one; a test may have its own. */
export class Engine {
  /**
   * @param {WebAssembly.Module} module
   * @param {{maximumMemory?: number}} [limits] in bytes, at most and by default 4 GiB
   */
  constructor(module, { maximumMemory = mostPages * pageSize } = {}) {
    const maximum = Math.min(mostPages, Math.max(initialPages, Math.floor(maximumMemory / pageSize)));
    /** @type {WebAssembly.Memory} */
    this.memory = new WebAssembly.Memory({ initial: initialPages, maximum });
    const { exports } = new WebAssembly.Instance(module, {
      env: { memory: this.memory },
      wasi_snapshot_preview1: systemFunctions(() => new DataView(this.memory.buffer)),
    });
    /** @type {Record<string, (...args: any[]) => any>} */
    this.functions = /** @type {any} */ (exports);
    this.functions._initialize();
  }

  /**
   * Calls a function that returns a status.
   * @param {string} name
   * @param {any[]} args
   * @throws {RondelError} with the index of the first bad element
   * @throws {RangeError} where memory runs out
   */
  call(name, ...args) {
    const status = this.functions[name](...args);
    if (status === 0) return;
    if (status === outOfMemory) throw new RangeError("Rondel: out of memory");
    const message = this.text(this.functions.rondel_error_message());
    if (status === invalidInput) throw new RondelError(message, this.functions.rondel_error_index() >>> 0);
    throw new Error(message);
  }

  /** @param {number} bytes */
  allocate(bytes) {
    // The module counts bytes by 32 bits: 2^32 + 8 would be 8.
    const place = bytes < 2 ** 32 ? this.functions.malloc(Math.max(bytes, 8)) >>> 0 : 0;
    if (place === 0) throw new RangeError("Rondel: out of memory");
    return place;
  }

  /**
   * Calls work(scope); what the scope allocated is freed when it ends.
   * @template T
   * @param {(scope: Scope) => T} work
   */
  scoped(work) {
    const scope = new Scope(this);
    try {
      return work(scope);
    } finally {
      scope.free();
    }
  }

  /** A copy of n numbers. @param {number} place @param {number} n */
  doubles(place, n) {
    return new Float64Array(this.memory.buffer, place >>> 0, n).slice();
  }

  /** A copy of n numbers. @param {number} place @param {number} n */
  indices(place, n) {
    return new Uint32Array(this.memory.buffer, place >>> 0, n).slice();
  }

  /** A copy of n 64-bit numbers, each below 2^32 as all that lies in this memory. @param {number} place @param {number} n */
  offsets(place, n) {
    const words = new Uint32Array(this.memory.buffer, place >>> 0, 2 * n);
    const result = new Uint32Array(n);
    for (let i = 0; i < n; ++i) result[i] = words[2 * i];
    return result;
  }

  /** @param {number} place of a text that ends with a zero */
  text(place) {
    const bytes = new Uint8Array(this.memory.buffer, place >>> 0);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }
}

/** Memory of the module for one call. */
class Scope {
  /** @param {Engine} engine */
  constructor(engine) {
    this.engine = engine;
    /** @type {number[]} */
    this.places = [];
  }

  /** Allocates n elements of 4 or 8 bytes. @param {number} n @param {4 | 8} [size] */
  room(n, size = 4) {
    const place = this.engine.allocate(n * size);
    this.places.push(place);
    return place;
  }

  /** A copy of an array. @param {Values} values */
  copy(values) {
    const place = this.room(values.length, /** @type {4 | 8} */ (values.BYTES_PER_ELEMENT));
    // Not values.constructor: a derived class may have any.
    const Type = [Float64Array, Uint32Array, Int32Array].find((type) => values instanceof type) ?? Float64Array;
    new Type(this.engine.memory.buffer, place, values.length).set(values);
    return place;
  }

  /** Calls a function whose last argument is the address of a pointer, and returns the pointer. @param {string} name @param {any[]} args */
  made(name, ...args) {
    const place = this.room(1);
    this.engine.call(name, ...args, place);
    return this.engine.indices(place, 1)[0];
  }

  free() {
    for (const place of this.places) this.engine.functions.free(place);
  }
}

/** @param {any} source */
function isModuleOfAnyKind(source) {
  try {
    return WebAssembly.validate(source);
  } catch {
    return false; // shared memory, or memory of another thread
  }
}

/**
 * Compiles what a user has in place of the package's text.
 * @param {BufferSource | WebAssembly.Module} source
 * @param {string} needed a function that the right module has
 */
async function compiledFrom(source, needed) {
  const kind = Object.prototype.toString.call(source);
  const isModule = kind === "[object WebAssembly.Module]";
  if (!isModule && !ArrayBuffer.isView(source) && kind !== "[object ArrayBuffer]") {
    throw new TypeError(`source: bytes or a WebAssembly.Module are wanted, not ${shown(source)}`);
  }
  const wrong = new RondelError("source: this is not the package's module of WebAssembly", 0);
  const module = isModule
    ? /** @type {WebAssembly.Module} */ (source)
    : await WebAssembly.compile(/** @type {BufferSource} */ (source)).catch((error) => {
        throw isModuleOfAnyKind(source) ? error : wrong; // a page may allow none
      });
  if (WebAssembly.Module.exports(module).some(({ name }) => name === needed)) return module;
  throw wrong;
}

/**
 * Returns the functions that load a module: each module of the package has one engine that all functions share.
 * @param {string} encoded the module in base64
 * @param {string} needed a function that this module alone has
 */
export function loader(encoded, needed) {
  /** @type {Engine | undefined} */
  let shared;
  const compiled = () => new WebAssembly.Module(decode(encoded));
  return {
    /** Returns the engine that all functions share; compiles it when it is needed for the first time. */
    engine() {
      shared ??= new Engine(compiled());
      return shared;
    },
    /** @param {BufferSource | WebAssembly.Module} [source] */
    async init(source) {
      if (shared && source === undefined) return;
      const module = await (source === undefined ? WebAssembly.compile(decode(encoded)) : compiledFrom(source, needed));
      shared ??= new Engine(module);
    },
    /** @param {{maximumMemory?: number}} limits */
    separateEngine: (limits) => new Engine(compiled(), limits),
  };
}

/**
 * Converts longitudes and latitudes in degrees, of shape (n, 2), to unit vectors of shape (n, 3).
 * @param {Engine} owner
 * @param {Float64Array} lonLat
 */
export function unitVectorsBy(owner, lonLat) {
  const n = lonLat.length / 2;
  return owner.scoped((scope) => {
    const place = scope.room(3 * n, 8);
    owner.call("rondel_unit_vectors", scope.copy(lonLat), n, place);
    return owner.doubles(place, 3 * n);
  });
}

// Objects that are not freed by free() are freed some time after the garbage collector has found them.
/** @type {FinalizationRegistry<{owner: Engine, name: string, place: number}>} */
const forgotten = new FinalizationRegistry(({ owner, name, place }) => owner.functions[name](place));

/** The method that `using` calls, even if the engine does not support it yet. @type {typeof Symbol.dispose} */
export const dispose = Symbol.dispose ?? Symbol.for("Symbol.dispose");

/** An object in the memory of the module. */
export class Handle {
  #place;
  #name;

  /**
   * @param {Engine} owner
   * @param {string} name of the function that frees it
   * @param {number} place
   */
  constructor(owner, name, place) {
    /** @type {Engine} */
    this.engine = owner;
    this.#place = place;
    this.#name = name;
    forgotten.register(this, { owner, name, place }, this);
  }

  /** @throws {RondelError} if it was freed */
  get place() {
    if (this.#place === 0) throw new RondelError("this object is used after free()", 0);
    return this.#place;
  }

  free() {
    if (this.#place === 0) return;
    forgotten.unregister(this);
    this.engine.functions[this.#name](this.#place);
    this.#place = 0;
  }
}
