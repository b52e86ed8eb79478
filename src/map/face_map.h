// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The solid faces of a triangulation as polygons in longitude and latitude.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "map/polygon.h"
#include "rondel/triangulation.h"

namespace rondel::map {

// Sides are within a hundredth of a degree of the arcs, and within a tenth of the width of the
// thinner of the two faces at an edge, so that faces do not overlap; but never closer than a meter
// on the earth.
class FaceMap {
 public:
  explicit FaceMap(const Triangulation& triangulation)
      : sites_(triangulation.sites().points()), triangulation_(triangulation) {}

  // The polygons of a solid face; none if the face is no wider than rounding.
  [[nodiscard]] std::vector<LonLatPolygon> polygons(Index face) const;

 private:
  using Corners = std::array<Point, 3>;

  [[nodiscard]] Corners ring(Index face) const;
  [[nodiscard]] std::array<double, 3> tolerances(Index face) const;
  [[nodiscard]] double tolerance(Index face) const;

  std::span<const Point> sites_;
  const Triangulation& triangulation_;
};

}  // namespace rondel::map
