// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Measures cells whose sides are straight in longitude and latitude, without arcs in their place.
//
// in    sides in degrees, each with its cell to the left
// out   areas, moments and lengths of the cells
// index cells
#pragma once

#include <cstdint>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::overlay {

inline constexpr double radians_of_degree = std::numbers::pi / 180;

// Which border of a cell counts: the arcs that every cell has, or, where they are known, the straight
// sides that these arcs stand for. In a grid of meridians and parallels straight sides are exact.
// Other cells have arcs for sides, and meet arcs.
enum class Borders : std::uint8_t { arcs, straight };

// A side that leads from west to east, the same for both of its directions but for the sign.
struct EastwardSide {
  LonLat west;
  LonLat east;
  double sign;  // 1 if the cell is to the south, -1 if it is to the north
};
EastwardSide eastward(const LonLatSide& side);

// Returns the mean over a straight line of the sine of latitude, less that of the latitude `low_deg`.
// The error is relative where all three latitudes are near each other, also at a pole.
double mean_rise(double low_deg, double from_deg, double to_deg);

// Returns the mean over a straight line of 1 - |sine of latitude|, for a line on one side of the
// equator. The error is relative, also at a pole.
double mean_gap(double from_deg, double to_deg);

// A straight line over a parallel that it does not cross, with `width` in radians of longitude.
struct LineAbove {
  double low_deg;   // the parallel
  double west_deg;  // latitudes of the ends
  double east_deg;
  double width;
};
// Returns the integral of the unit vector over the region between the line and the parallel.
// meridian(share) is the point of the equator at a share of the width from the western end.
Point moment_above(const LineAbove& line, const std::function<Point(double)>& meridian);

// The straight sides of cells, and what these measure.
class StraightSides {
 public:
  // `areas` and `lengths` are those of the arcs; cells without straight sides keep them.
  StraightSides(CompressedRows<LonLatSide> rows, std::vector<double> areas,
                std::vector<double> lengths, unsigned threads);

  [[nodiscard]] const CompressedRows<LonLatSide>& rows() const { return rows_; }
  // Returns the area of each cell, in steradians.
  [[nodiscard]] const std::vector<double>& areas() const { return areas_; }
  // Returns bounds for the lengths of the borders, in radians.
  [[nodiscard]] const std::vector<double>& lengths() const { return lengths_; }
  // Returns the first moment of a cell that has straight sides.
  [[nodiscard]] Point moment(Index cell) const;

 private:
  CompressedRows<LonLatSide> rows_;
  std::vector<double> areas_;
  std::vector<double> lengths_;
};

}  // namespace rondel::overlay
