// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Starts the page to play. window.rondelGlobe is for tests.

import { readPage } from "../../../viewer/src/decode.js";
import { Play } from "./play.js";
import { Remote } from "./remote.js";

async function startPlay() {
  const stop = ({ message }) => {
    document.documentElement.dataset.state = "failed";
    const failure = document.getElementById("failure");
    failure.textContent = `The globe cannot be shown: ${message}`;
    failure.hidden = false;
  };
  try {
    const { arrays } = await readPage(document);
    const remote = new Remote(document.getElementById("worker").textContent, {
      fail: stop,
      show(state) {
        try {
          const play = new Play(document, state, arrays.coast, remote);
          remote.show = (...answer) => play.show(...answer);
          remote.fail = (...error) => play.fail(...error);
          window.rondelGlobe = play;
          play.files.first();
        } catch (error) {
          stop(error);
        }
      },
    });
    remote.ask("begin", arrays.module);
  } catch (error) {
    stop(error);
  }
}

startPlay();
