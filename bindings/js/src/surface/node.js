// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The entry of a thread of Node.js, with the messages of browser.js.

import { parentPort } from "node:worker_threads";
import { answer } from "./serve.js";

const port = /** @type {import("node:worker_threads").MessagePort} */ (parentPort);
port.on("message", (message) => answer(message, (reply, transfer) => port.postMessage(reply, transfer)));
