// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arcs of great circles, cut by the meridians and parallels of a grid.
//
// Nothing is decided here that rounding could get wrong: points have rounded places, arcs are what joins these
// places, and what is summed of them is continuous in the places. An arc gives the same numbers both ways.
#pragma once

#include <vector>

#include "overlay/graticule.h"
#include "rondel/types.h"

namespace rondel::overlay {

struct GraticulePlace {
  Point point;
  double radius = 0;  // distance from the axis
  double gap = 0;     // of its height
  Index column = 0;
  double offset = 0;  // radians east of the column's western meridian

  [[nodiscard]] SphereHeight height() const { return {point.z, gap}; }
};

// What is between the part of an arc in a row of a column and the row's southern parallel, or near a pole that pole, which is
// counted as if it was south of the arc. It is negative for arcs that run east, whose cell is to the north.
struct Strip {
  Index column = 0;
  Index row = 0;
  double pole = 0;  // its sine; 0: the area is above the parallel
  double area = 0;
  double width = 0;   // radians
  double length = 0;  // of the arc, roughly
  Point run{};        // difference of its ends' meridians on the equator
  Point moment{};
};

class GraticuleWalk {
 public:
  GraticuleWalk(const Graticule& grid, bool has_moments) : grid_(grid), has_moments_(has_moments) {}

  [[nodiscard]] GraticulePlace place_of(const Point& point) const;

  // Appends the strips of the arc from one place to the other.
  void append(const GraticulePlace& from, const GraticulePlace& to,
              std::vector<Strip>& strips) const;

 private:
  struct Out {
    double sign;
    std::vector<Strip>& strips;
  };
  [[nodiscard]] double turn(const GraticulePlace& place) const {
    return grid_.columns()[place.column].start + place.offset;
  }
  [[nodiscard]] Index row_of(const SphereHeight& height) const;
  [[nodiscard]] bool has_extreme(const GraticulePlace& from, const GraticulePlace& to,
                                 GraticulePlace& extreme) const;
  [[nodiscard]] GraticulePlace on_parallel(const GraticulePlace& from, const GraticulePlace& to,
                                           const Graticule::Parallel& parallel,
                                           bool is_north) const;
  // From west to east.
  void append_columns(const GraticulePlace& from, const GraticulePlace& to, const Out& out) const;
  void append_rows(const GraticulePlace& from, const GraticulePlace& to, const Out& out) const;
  void append_strip(const GraticulePlace& from, const GraticulePlace& to, Index row,
                    const Out& out) const;

  const Graticule& grid_;
  bool has_moments_;
};

}  // namespace rondel::overlay
