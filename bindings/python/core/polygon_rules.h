// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The options of polygons, which Python passes as words.
#pragma once

#include <nanobind/nanobind.h>

#include "named.h"
#include "rondel/polygon_files.h"

namespace rondel::python {

// Returns the options that the words edges='lonlat' and so on stand for. Raises ValueError for
// other words. Call these functions with the lock of the interpreter.
inline PolygonOptions polygon_rules(nb::handle edges) {
  return {.edges = named<PolygonEdges>("edges", edges)};
}
inline PolygonOptions polygon_rules(nb::handle edges, nb::handle invalid) {
  PolygonOptions rules = polygon_rules(edges);
  rules.invalid = named<InvalidPolygons>("invalid", invalid);
  return rules;
}
inline PolygonOptions polygon_rules(nb::handle edges, nb::handle overlap, nb::handle invalid) {
  PolygonOptions rules = polygon_rules(edges, invalid);
  rules.overlap = named<PolygonOverlap>("overlap", overlap);
  return rules;
}

}  // namespace rondel::python
