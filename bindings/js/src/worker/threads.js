// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A thread of Node.js.

import { Worker } from "node:worker_threads";

/** @param {URL} [entry] the code of the thread @returns {import("./index.js").Connection} */
export function spawnThread(entry = new URL("./node.js", import.meta.url)) {
  const worker = new Worker(entry);
  return {
    post: (message) => worker.postMessage(message),
    listen: (handle, fail) => {
      worker.on("message", handle);
      worker.on("messageerror", (error) => fail(error.message));
      worker.on("error", (error) => fail(error.message));
      worker.on("exit", (code) => fail(`it ended with code ${code}`));
    },
    stop: async () => void (await worker.terminate()),
  };
}
