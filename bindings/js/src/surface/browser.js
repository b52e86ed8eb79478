// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/**
 * The entry of a Web Worker for viewers of irregular grids: it answers each message `{id, lon, lat, show, spacing, values,
 * levels}`, of which only `lon` and `lat` are needed, by `{id, positions, indices, ...}`, or by `{id, error}` if the sites
 * or the options are not valid, in the order of the messages.
 * @module
 */

import { answer } from "./serve.js";

const self = /** @type {any} */ (globalThis);
self.onmessage = (/** @type {any} */ event) =>
  answer(event.data, (reply, transfer) => self.postMessage(reply, transfer));
