// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The engine of rondel.wasm, which has all but what computes with polygons.

import { loader } from "./instance.js";
import { encodedModule } from "./module.js";

/** @typedef {import("./instance.js").Engine} Engine */

const shared = loader(encodedModule, "rondel_delaunay");
export const engine = shared.engine;
export const separateEngine = shared.separateEngine;

/**
 * Compiles the module without blocking, for pages whose browser refuses to compile large modules at once on its main
 * thread, or that do not want to wait. Everywhere else the first call of any function does that by itself.
 * @param {BufferSource | WebAssembly.Module} [source] the module, of this version, where it comes from elsewhere than
 *   from this package's text
 * @returns {Promise<void>}
 * @throws {import("./errors.js").RondelError} if it is another module
 */
export function init(source) {
  return shared.init(source);
}
