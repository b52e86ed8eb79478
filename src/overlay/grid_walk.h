// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cuts arcs of great circles at the meridians and parallels of a grid.
//
// in    arcs
// out   strips: signed areas between parts of the arc and a parallel, each in one column and row
// index columns and rows of a PreparedGrid
//
// No decision is made here that rounding could get wrong. Points have rounded places, an arc joins
// two such places, and the sums over strips are continuous functions of the places. Both directions
// of an arc give the same numbers.
#pragma once

#include <vector>

#include "overlay/prepared_grid.h"
#include "rondel/types.h"

namespace rondel::overlay {

// A point with its place in the grid.
struct PlaceInGrid {
  Point point;
  double radius = 0;  // distance from the axis
  double gap = 0;     // see SphereHeight
  Index column = 0;
  Index row = 0;
  double offset = 0;  // radians east of the column's western meridian

  [[nodiscard]] SphereHeight height() const { return {point.z, gap}; }
};

// The region between the part of an arc in one row of one column and the row's southern parallel.
// Near a pole it is the region between the arc and the pole, counted as if the pole were south of
// the arc. Its area is negative for arcs that lead east, which have their cell to the north.
struct Strip {
  Index column = 0;
  Index row = 0;
  double pole = 0;  // the sine of that pole's latitude; 0 if the area is above the parallel
  double area = 0;
  double width = 0;  // radians
  // The rounding error of the width: their sum is the exact difference of two offsets.
  double width_rest = 0;
  double length = 0;  // approximate length of the part of the arc, radians
  Point run{};        // difference of the points where the ends' meridians meet the equator
  Point moment{};
};

// Cuts arcs into strips.
class GridWalk {
 public:
  GridWalk(const PreparedGrid& grid, bool has_moments) : grid_(grid), has_moments_(has_moments) {}

  // Returns the place of a unit vector in the grid.
  [[nodiscard]] PlaceInGrid place_of(const Point& point) const;

  // Appends the strips of the arc between two places.
  void append(const PlaceInGrid& from, const PlaceInGrid& to, std::vector<Strip>& strips) const;

 private:
  // The strips that are appended to, and the sign of the arc's direction.
  struct Out {
    double sign;
    std::vector<Strip>& strips;
  };
  // Returns how far a place is east of the first column's western meridian, in radians.
  [[nodiscard]] double turn(const PlaceInGrid& place) const {
    return grid_.columns()[place.column].start + place.offset;
  }
  [[nodiscard]] Index row_of(const SphereHeight& height) const {
    return row_between(height, 0, grid_.num_rows() - 1);
  }
  // Returns the row of a height that is in one of these rows but for rounding.
  [[nodiscard]] Index row_between(const SphereHeight& height, Index southern, Index northern) const;
  [[nodiscard]] bool has_extreme(const PlaceInGrid& from, const PlaceInGrid& to,
                                 PlaceInGrid& extreme) const;
  [[nodiscard]] PlaceInGrid on_parallel(const PlaceInGrid& from, const PlaceInGrid& to,
                                        const PreparedGrid::Parallel& parallel,
                                        bool is_north) const;
  // Appends the strips of an arc that leads from west to east.
  void append_columns(const PlaceInGrid& from, const PlaceInGrid& to, const Out& out) const;
  void append_rows(const PlaceInGrid& from, Index row, const PlaceInGrid& to, Index last_row,
                   const Out& out) const;
  void append_strip(const PlaceInGrid& from, const PlaceInGrid& to, Index row,
                    const Out& out) const;

  const PreparedGrid& grid_;
  bool has_moments_;
};

}  // namespace rondel::overlay
