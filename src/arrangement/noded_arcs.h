// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arcs between nodes: what goes into each step of an arrangement and comes out of it.
//
// index nodes: along the spatial order; arcs: in lexicographic order of their nodes
#pragma once

#include <vector>

#include "exact/eft.h"
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

// Returns a x (b - a) with a small relative error, also if b is nearly opposite to a, where the
// product is much shorter than the step.
inline Vec normal_of(const Point& a, const Point& b) {
  constexpr double least_cosine = -0.9;
  const Vec from = exact::to_vector(a);
  if (dot(a, b) > least_cosine) return cross(from, exact::to_vector(b) - from);
  const exact::Vector3<exact::DoubleDouble> p = {{a.x, 0}, {a.y, 0}, {a.z, 0}};
  const exact::Vector3<exact::DoubleDouble> normal = cross(p, exact::difference(b, a));
  return {normal.x.hi, normal.y.hi, normal.z.hi};
}

}  // namespace rondel::arrangement
