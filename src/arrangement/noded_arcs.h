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
struct NodedArc {
  Index from;
  Index to;
  friend auto operator<=>(const NodedArc&, const NodedArc&) = default;
};

struct NodedArcs {
  std::vector<Point> nodes;    // on different rays
  std::vector<NodedArc> arcs;  // different ones, ascending

  [[nodiscard]] const Point& from(Index arc) const { return nodes[arcs[arc].from]; }
  [[nodiscard]] const Point& to(Index arc) const { return nodes[arcs[arc].to]; }
};

// Returns the cross product of two points with a small relative error, however near to each other
// or to opposite points they are: as a x (b - a) in double-double, which is off by 2^-104 |b - a|.
inline exact::Vector3<exact::DoubleDouble> precise_normal_of(const Point& a, const Point& b) {
  const exact::Vector3<exact::DoubleDouble> step = exact::difference(b, a);
  return {step.z * a.y - step.y * a.z, step.x * a.z - step.z * a.x, step.y * a.x - step.x * a.y};
}
inline Vec normal_of(const Point& a, const Point& b) {
  const auto normal = precise_normal_of(a, b);
  return {normal.x.hi, normal.y.hi, normal.z.hi};
}

}  // namespace rondel::arrangement
