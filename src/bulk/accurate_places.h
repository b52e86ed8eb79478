// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A filter for sites that are almost on one great circle, as those of grids are, in the projected
// model: with numbers of 64 bits, where the machine has them. The next rung takes several times as
// long. Differences of places have a small relative error (docs/theory/blocks.md).
#pragma once

#include <span>
#include <vector>

#include "bulk/square_point.h"
#include "order/cube_position.h"

namespace rondel::bulk {

class AccuratePlaces {
 public:
  // The sites sites[order[0]], ...
  void assign(std::span<const Point> sites, std::span<const Index> order, const Point& center);
  // From now on questions are about those on this face of the cube, which are points[i].
  void enter(const SquarePoint* points, unsigned cube_face);

  // Positive if c lies to the left of the edge from a to b, zero if this is not certain.
  [[nodiscard]] Sign orientation(Index a, Index b, Index c);

 private:
  // What the numbers of a SquarePoint lack; NaN if this is not known yet, infinite if it never is.
  struct Low {
    double u;
    double v;
  };

  [[nodiscard]] const Low& known_low(Index i);
  void find_low(Index i);

  const SquarePoint* points_ = nullptr;
  std::span<const Point> sites_;
  std::span<const Index> order_;
  Point center_;
  order::CubeAxes axes_;
  double hand_ = 1;
  std::vector<Low> lows_;  // empty until the first question
};

}  // namespace rondel::bulk
