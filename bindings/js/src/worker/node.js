// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The entry of a thread of Node.js.

import { parentPort } from "node:worker_threads";
import { serve } from "./serve.js";

const port = /** @type {import("node:worker_threads").MessagePort} */ (parentPort);
port.on("message", (message) => serve(message, (reply, transfer) => port.postMessage(reply, transfer)));
