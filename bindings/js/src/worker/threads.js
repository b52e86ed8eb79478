// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A thread of Node.js.

import { Worker } from "node:worker_threads";

/** @returns {import("./index.js").Connection} */
export function spawnThread() {
  const worker = new Worker(new URL("./node.js", import.meta.url));
  return {
    post: (message) => worker.postMessage(message),
    listen: (handle) => void worker.on("message", handle),
    stop: async () => void (await worker.terminate()),
  };
}
