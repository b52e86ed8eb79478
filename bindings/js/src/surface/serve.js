// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The code that runs in `rondel/surface-worker`. Messages are plain objects:
//
//     {id, lon, lat, show, spacing, values, levels}  in; only lon and lat are needed
//     {id, positions, indices, ...}                  out, see Mesh and Lines; arrays are moved
//     {id, error: {name, message, index}}            out, if sites or options are not valid

import { surface } from "./index.js";

/**
 * Answers one request.
 * @param {import("./index.js").SurfaceRequest} request
 * @param {(answer: any, transfer: ArrayBuffer[]) => void} post
 */
export function answer(request, post) {
  const { id, lon, lat, ...options } = request ?? {};
  try {
    const made = surface({ lon, lat }, options);
    const arrays = Object.values(made).filter((value) => ArrayBuffer.isView(value));
    post({ id, ...made }, [...new Set(arrays.map((array) => /** @type {ArrayBuffer} */ (array.buffer)))]);
  } catch (error) {
    const { name, message, index } = /** @type {any} */ (error);
    post({ id, error: { name, message, index } }, []);
  }
}
