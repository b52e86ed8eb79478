// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The entry of a Web Worker.

import { serve } from "./serve.js";

const self = /** @type {any} */ (globalThis);
self.onmessage = (/** @type {any} */ event) =>
  serve(event.data, (reply, transfer) => self.postMessage(reply, transfer));
