// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The solid faces of a triangulation as polygons in longitude and latitude.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "map/polygon.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::map {

// Sides are within a hundredth of a degree of the arcs, and within a tenth of the width of the
// thinner of the two faces at an edge, so that faces do not overlap; but never closer than a meter
// on the earth.
//
// Where lines of a face cross nevertheless, or have passed each other, as it is narrower than rounding or that meter, all
// faces are settled_regions().
//
// Most faces are small, and each of their sides is one straight line: such a face is its corners,
// which are placed on the map once for all faces. All others are drawn.
class FaceMap {
 public:
  FaceMap(const Triangulation& triangulation, const Execution& execution);

  // Memory for drawing a face; one for each thread.
  using Pen = std::vector<LonLatPolygon>;

  // The polygons of a solid face, until the pen is used again; none if the face is no wider than
  // rounding.
  [[nodiscard]] const std::vector<LonLatPolygon>& polygons(Index face, Pen& pen) const;

 private:
  using Corners = std::array<Point, 3>;

  [[nodiscard]] Corners ring(Index face) const;
  [[nodiscard]] bool is_plain(Index face) const;
  [[nodiscard]] std::vector<std::vector<LonLat>> loops_of(Index face) const;
  [[nodiscard]] bool has_trouble(const Execution& execution) const;
  void settle(const Execution& execution);
  [[nodiscard]] std::array<double, 3> tolerances(Index face) const;
  [[nodiscard]] double tolerance(Index face) const;
  [[nodiscard]] bool is_plain(const Corners& corners, std::span<const LonLat> positions,
                              const std::array<double, 3>& tolerances_deg) const;

  const Triangulation& triangulation_;
  std::vector<Point> directions_;                    // of the sites, from the center
  std::vector<LonLat> positions_;                    // of the sites
  std::vector<double> tolerances_deg_;               // of the faces
  std::vector<std::vector<LonLatPolygon>> settled_;  // of all faces, if any
};

}  // namespace rondel::map
