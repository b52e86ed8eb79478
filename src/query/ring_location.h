// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where a direction is among the arcs of a ring (dimensions 0 and 1), exactly.
//
// An edge from one vertex to the next is solid when its arc is shorter than 180 degrees in the
// sense of the ring. As in dimension 2 the solid edges cover a convex cone of directions, here
// within the plane of the ring.
#pragma once

#include <array>
#include <vector>

#include "rondel/query.h"
#include "rondel/types.h"

namespace rondel::query {

class RingLocation {
 public:
  // The vertices in their order, as great_circle.h makes it.
  RingLocation(std::vector<Point> points, const Point& center);

  // `near` is a vertex to start from: the nearest one. Vertices are positions in the ring.
  [[nodiscard]] Location locate(const Point& p, Index near) const;

 private:
  [[nodiscard]] Index next(Index i) const { return i + 1 < points_.size() ? i + 1 : 0; }
  [[nodiscard]] Index previous(Index i) const {
    return i > 0 ? i - 1 : static_cast<Index>(points_.size()) - 1;
  }
  // Positive: p is less than 180 degrees ahead of vertex i.
  [[nodiscard]] Sign turn(Index i, const Point& p) const;
  [[nodiscard]] bool is_solid(Index edge) const;
  [[nodiscard]] bool is_in_plane(const Point& p) const;
  [[nodiscard]] Location walk(const Point& p, Index edge) const;

  std::vector<Point> points_;
  Point center_;
  std::array<Index, 2> spanning_ = {no_index,
                                    no_index};  // two vertices not in line with the center
  unsigned axis_ = 0;  // the plane is seen along the first axis that is not in it
  Index solid_ = no_index;
};

}  // namespace rondel::query
