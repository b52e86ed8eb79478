// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Grids of meridians and parallels, prepared for an overlay.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "exact/vector.h"
#include "rondel/partition.h"
#include "rondel/types.h"

namespace rondel::overlay {

// From here on to the poles, 2.5 degrees, heights are compared by their gaps.
inline constexpr double polar_sine = 1 - 0x1p-10;

// A place's distance from the equator's plane, and what it lacks to 1, which is known better near the poles; 0 elsewhere.
struct SphereHeight {
  double sine;
  double gap;
};
inline SphereHeight height_of(double sine, double radius) {
  const double above = std::abs(sine);
  return {sine, above > polar_sine ? radius * radius / (1 + above) : 0};
}

inline bool is_polar(const SphereHeight& low, const SphereHeight& high) {
  return std::abs(low.sine) > polar_sine && std::abs(high.sine) > polar_sine &&
         (low.sine > 0) == (high.sine > 0);
}

// By how much the sine of `high` is larger: to rounding of that near the equator, and near a pole to rounding of the gaps.
inline double rise(const SphereHeight& low, const SphereHeight& high) {
  if (!is_polar(low, high)) return high.sine - low.sine;
  return low.sine > 0 ? low.gap - high.gap : high.gap - low.gap;
}

// Meridians, or parallels, nearer than this to each other are one.
inline constexpr double same_line_degrees = 0x1p-44 * 360;

// Columns from west to east and rows from south to north. Where the grid does not go around the globe or to a pole,
// further columns and rows, which are no cells, fill it.
class Graticule {
 public:
  struct Lune {
    Point west;       // where its western meridian meets the equator
    double start;     // radians east of the first column's western meridian
    double width;     // radians
    Index of_grid;    // no_index: none
    double west_deg;  // of a column of the grid
    double east_deg;
  };
  struct Parallel {
    double sine;
    double cosine;
    double lat_deg;
    double gap;
    [[nodiscard]] SphereHeight height() const { return {sine, gap}; }
  };

  // Throws InvalidInput.
  explicit Graticule(const LonLatGrid& grid);

  [[nodiscard]] Index num_cells() const { return num_columns_of_grid_ * num_rows_of_grid_; }
  [[nodiscard]] Index num_columns_of_grid() const { return num_columns_of_grid_; }
  [[nodiscard]] Index num_rows_of_grid() const { return num_rows_of_grid_; }
  [[nodiscard]] bool is_around() const { return is_around_; }
  [[nodiscard]] bool is_cover() const {
    return is_around_ && num_rows_of_grid_ == num_rows() && first_row_ == 0;
  }

  [[nodiscard]] const std::vector<Lune>& columns() const { return columns_; }
  [[nodiscard]] Index num_rows() const { return static_cast<Index>(parallels_.size() - 1); }
  // The southern one of a row; of the number of rows, the northern pole.
  [[nodiscard]] const Parallel& parallel(Index row) const { return parallels_[row]; }
  // In degrees, southern and northern, of a row of the grid.
  [[nodiscard]] const std::vector<double>& latitudes() const { return latitudes_; }
  [[nodiscard]] Index first_row() const { return first_row_; }
  // The cell there; no_index: none.
  [[nodiscard]] Index cell(Index column, Index row) const;
  [[nodiscard]] double area(Index column, Index row) const {
    return columns_[column].width * heights_[row];
  }
  // What the sines of a row's parallels differ by.
  [[nodiscard]] double height(Index row) const { return heights_[row]; }
  // Where the meridian `offset` radians east of a column's western one meets the equator.
  [[nodiscard]] Point meridian(Index column, double offset) const;
  [[nodiscard]] Point eastern_meridian(Index column) const {
    return columns_[column + 1 < columns_.size() ? column + 1 : 0].west;
  }

  // By cell.
  [[nodiscard]] std::vector<double> areas() const;
  [[nodiscard]] std::vector<Point> moments() const;
  // Of borders.
  [[nodiscard]] std::vector<double> lengths() const;
  // Cells that share a side, in any order, some of them twice.
  void append_neighbors(Index cell, std::vector<Index>& neighbors) const;

 private:
  void take_columns(std::vector<double> lon);
  void take_rows(std::vector<double> lat);

  Index num_columns_of_grid_;
  Index num_rows_of_grid_;
  bool is_around_ = false;
  bool is_southward_ = false;  // the grid's rows
  Index first_row_ = 0;        // that is one of the grid
  std::vector<Lune> columns_;
  std::vector<Parallel> parallels_;
  std::vector<double> heights_;  // of rows
  std::vector<double> latitudes_;
};

// What the sines of two parallels differ by, to some units in the last place.
double height_between(const Graticule::Parallel& south, const Graticule::Parallel& north);

// The integral of q over the part of a row, of this height_between(), where q's longitude is in a range: `run` is the
// difference of the eastern and the western end of the range, on the equator.
Point moment_of_row(const Graticule::Parallel& south, const Graticule::Parallel& north,
                    double height, double width, const Point& run);

// The cells of a grid with sides on great circles, named as those of the grid.
CellRings rings_of(const LonLatGrid& grid);

}  // namespace rondel::overlay
