// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arcs between nodes: what goes into each step of an arrangement and comes out of it.
//
// index nodes: along the spatial order; arcs: in lexicographic order of their nodes
#pragma once

#include <vector>

#include "exact/vector.h"
#include "rondel/types.h"

namespace rondel::arrangement {

using Vec = exact::Vector3<double>;

// The shorter arc between two nodes, `from` <= `to`. It is a point if they are equal.
struct Arc {
  Index from;
  Index to;
  friend auto operator<=>(const Arc&, const Arc&) = default;
};

struct NodedArcs {
  std::vector<Point> nodes;  // on different rays
  std::vector<Arc> arcs;     // different ones, ascending

  [[nodiscard]] const Point& from(Index arc) const { return nodes[arcs[arc].from]; }
  [[nodiscard]] const Point& to(Index arc) const { return nodes[arcs[arc].to]; }
};

}  // namespace rondel::arrangement
