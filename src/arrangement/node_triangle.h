// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The triangle between a corner of a line and its neighbors, exactly.
//
//        b            The triangle has its sides and corners. If all three are on a great circle,
//      /   \          it is the shortest arc of it that has them.
//    a - - - c
//
// index nodes, whose places are on different rays
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "arrangement/box_tree.h"
#include "arrangement/directions.h"
#include "arrangement/sided_arc.h"
#include "rondel/predicates.h"
#include "rondel/types.h"

namespace rondel::arrangement {

class NodeTriangle {
 public:
  // No two of the nodes may be opposite to each other, and the arc from a to c is no longer than 90
  // degrees.
  NodeTriangle(std::span<const Point> points, Index a, Index b, Index c)
      : points_(points),
        nodes_{a, b, c},
        arcs_{SidedArc(points[a], points[b]), SidedArc(points[b], points[c]),
              SidedArc(points[c], points[a])},
        turn_(arcs_[0].side(points[c])) {
    if (turn_ == 0) turn_ = static_cast<int>(orientation(points[a], points[b], points[c]));
  }

  // True if another node is in the triangle.
  [[nodiscard]] bool has(Index node) const {
    if (std::ranges::find(nodes_, node) != nodes_.end()) return false;
    const Point& p = points_[node];
    if (turn_ == 0) {
      return side(0, p) == 0 &&
             (is_between(corner(0), corner(1), p) || is_between(corner(1), corner(2), p) ||
              is_between(corner(2), corner(0), p));
    }
    return side(0, p) * turn_ >= 0 && side(1, p) * turn_ >= 0 && side(2, p) * turn_ >= 0;
  }

  // Returns a box that has the triangle. A place of the flat triangle whose sides have at most the
  // length s is at least sqrt(1 - s^2 / 3) from the center, and so at most s^2 / 3 below the sphere.
  [[nodiscard]] SpaceBox box() const {
    constexpr double rounding = 0x1p-40;
    double longest = 0;
    SpaceBox box = empty_box;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& p = corner(i);
      const Point step = p - corner((i + 1) % 3);
      longest = std::max(longest, dot(step, step));
      box.include({{p.x, p.y, p.z}, {p.x, p.y, p.z}});
    }
    if (longest > 1) return whole_box;
    box.widen(longest / 3 + rounding);
    return box;
  }

 private:
  [[nodiscard]] const Point& corner(std::size_t i) const { return points_[nodes_[i]]; }
  [[nodiscard]] int side(std::size_t i, const Point& p) const {
    const int sure = arcs_[i].side(p);
    return sure != 0 ? sure : static_cast<int>(orientation(corner(i), corner((i + 1) % 3), p));
  }

  std::span<const Point> points_;
  std::array<Index, 3> nodes_;
  std::array<SidedArc, 3> arcs_;
  int turn_;
};

}  // namespace rondel::arrangement
