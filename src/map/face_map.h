// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Draws the solid faces of a triangulation as polygons in longitude and latitude.
//
// in    a triangulation
// out   polygons in degrees for each solid face
// index faces
#pragma once

#include <array>
#include <span>
#include <vector>

#include "map/polygon.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::map {

// Draws one face at a time. A side is within a hundredth of a degree of its arc, and within a tenth
// of the width of the thinner one of the two faces at the edge, so that faces do not overlap, but
// never nearer than a meter on the earth.
//
// If lines of a face cross nevertheless, or have passed each other, because the face is narrower
// than rounding or that meter, all faces are replaced by settled_regions().
//
// Most faces are small, and each of their sides is one straight line. Such a face has just its
// corners, whose positions are computed once for all faces. Other faces are drawn.
class FaceMap {
 public:
  FaceMap(const Triangulation& triangulation, const Execution& execution);

  // The working memory for drawing a face. Each thread needs its own.
  using Pen = std::vector<LonLatPolygon>;

  // Returns the polygons of a solid face, empty if the face is no wider than rounding. The
  // reference is valid until the pen is used again.
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
  std::vector<Point> directions_;       // unit vectors from the center to the sites
  std::vector<LonLat> positions_;       // of each site, degrees
  std::vector<double> tolerances_deg_;  // of each face
  // The polygons of each face if faces were settled; else empty.
  std::vector<std::vector<LonLatPolygon>> settled_;
};

}  // namespace rondel::map
