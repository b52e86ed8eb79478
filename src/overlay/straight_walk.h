// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cuts sides that are straight in longitude and latitude at the meridians and parallels of a grid.
//
// in    straight sides in degrees
// out   strips, as those of arcs (overlay/grid_walk.h)
// index columns and rows of a PreparedGrid
//
// A corner no farther from a line of the grid than on_side_deg is on that line. So a polygon along
// the lines of the grid has whole cells, exactly, and none beyond. Both directions of a side give
// the same numbers.
#pragma once

#include <vector>

#include "overlay/grid_walk.h"
#include "overlay/prepared_grid.h"
#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

class StraightWalk {
 public:
  StraightWalk(const PreparedGrid& grid, bool has_moments)
      : grid_(grid), has_moments_(has_moments) {}

  // Appends the strips of a side, which may be longer than a turn of the globe.
  void append(const LonLatSide& side, std::vector<Strip>& strips) const;

 private:
  // A place on the map of the grid, whose columns repeat with every turn of the globe.
  struct PlaceOnMap {
    double turn;        // whole turns east of the first column
    Index column;       // of the grid
    double offset_deg;  // east of the column's western meridian
    double lat_deg;
  };
  // Returns a place, on the lines of the grid that it is next to.
  [[nodiscard]] PlaceOnMap place_of(const LonLat& position) const;
  [[nodiscard]] double on_parallels(double lat_deg) const;
  [[nodiscard]] double lon_of(const PlaceOnMap& place) const;
  [[nodiscard]] double width_deg(Index column) const;
  // Returns the row of a latitude; that of a parallel is the row north of it.
  [[nodiscard]] Index row_of(double lat_deg) const;
  // Appends the strips between two places of one column.
  void append_rows(const PlaceOnMap& west, const PlaceOnMap& east, double sign,
                   std::vector<Strip>& strips) const;
  void append_strip(const PlaceOnMap& west, const PlaceOnMap& east, Index row, double sign,
                    std::vector<Strip>& strips) const;

  const PreparedGrid& grid_;
  bool has_moments_;
};

}  // namespace rondel::overlay
