// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The page of `rondel plot`: a globe of what the page carries. window.rondelGlobe is for other scripts of the page,
// and for tests.

import { readPage } from "./decode.js";
import { Globe } from "./globe.js";
import { directionOf } from "./vectors.js";

async function start() {
  const status = document.getElementById("status");
  try {
    const { about, arrays } = await readPage(document);
    const globe = new Globe(document, about, arrays);
    window.rondelGlobe = globe;
    window.rondelGlobe.directionOf = directionOf;
    document.documentElement.dataset.state = "ready";
    status.textContent = "Ready";
  } catch (error) {
    document.documentElement.dataset.state = "failed";
    const message = document.getElementById("failure");
    message.textContent = `The globe cannot be shown: ${error.message}`;
    message.hidden = false;
  }
}

start();
