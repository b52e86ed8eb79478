// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Lines of equal value: points one after the other, and where each line ends. A closed line has its first point
// also at its end.

import { triple } from "./vectors.js";

export function isolineArcs({ isolines, isolineEnds }, arc) {
  let i = 0;
  for (const end of isolineEnds) {
    for (++i; i < end; ++i) arc(triple(isolines, i - 1), triple(isolines, i));
  }
}
