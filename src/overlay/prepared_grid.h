// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Grids of cells between meridians and parallels, prepared for an overlay.
//
// in    longitudes and latitudes of the grid's lines, in degrees and in any direction
// out   columns from west to east, rows from south to north, areas and moments of the cells
// index columns and rows as above; cells as in the given grid, latitude by latitude (nlat, nlon)
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "exact/vector.h"
#include "rondel/cell_set.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Where the sine of a latitude exceeds this (within 2.5 degrees of a pole), heights are compared by
// their gaps.
inline constexpr double polar_sine = 1 - 0x1p-10;

// The height of a place above the plane of the equator: the sine of its latitude, and near a pole
// also `gap` = 1 - |sine|, which is known with a smaller error. Elsewhere `gap` is 0.
struct SphereHeight {
  double sine;
  double gap;
};
// Returns the height of a place with this sine of latitude and this distance from the axis.
inline SphereHeight height_of(double sine, double radius) {
  const double above = std::abs(sine);
  return {sine, above > polar_sine ? radius * radius / (1 + above) : 0};
}

// True if both heights are near the same pole, so that their gaps can be compared.
inline bool is_polar(const SphereHeight& low, const SphereHeight& high) {
  return std::abs(low.sine) > polar_sine && std::abs(high.sine) > polar_sine &&
         (low.sine > 0) == (high.sine > 0);
}

// Returns the sine of `high` minus that of `low`. Its error is rounding of the sines near the
// equator, and rounding of the gaps near a pole.
inline double rise(const SphereHeight& low, const SphereHeight& high) {
  if (!is_polar(low, high)) return high.sine - low.sine;
  return low.sine > 0 ? low.gap - high.gap : high.gap - low.gap;
}

// Meridians, or parallels, that are nearer to each other than this are one.
inline constexpr double same_line_degrees = 0x1p-44 * 360;

// A grid of cells. Where the grid does not go around the globe or does not reach a pole, columns
// and rows without cells fill the rest of the sphere.
class PreparedGrid {
 public:
  // A column: the lune between two meridians.
  struct Lune {
    Point west;       // the point where the western meridian meets the equator
    double start;     // the western meridian, radians east of that of the first column
    double width;     // radians
    Index of_grid;    // the column of the given grid; no_index for the filling column
    double west_deg;  // degrees, as in the grid
    double east_deg;
  };
  // A line between two rows.
  struct Parallel {
    double sine;
    double cosine;
    double lat_deg;
    double gap;
    [[nodiscard]] SphereHeight height() const { return {sine, gap}; }
  };

  // Throws InvalidInput if the lines are not in order, are out of range, or bound no cell.
  explicit PreparedGrid(const LonLatGrid& grid);

  [[nodiscard]] Index num_cells() const { return num_columns_of_grid_ * num_rows_of_grid_; }
  [[nodiscard]] Index num_columns_of_grid() const { return num_columns_of_grid_; }
  [[nodiscard]] Index num_rows_of_grid() const { return num_rows_of_grid_; }
  [[nodiscard]] bool is_around() const { return is_around_; }
  // True if the cells of the grid cover the sphere.
  [[nodiscard]] bool covers_sphere() const {
    return is_around_ && num_rows_of_grid_ == num_rows() && first_row_ == 0;
  }

  [[nodiscard]] const std::vector<Lune>& columns() const { return columns_; }
  [[nodiscard]] Index num_rows() const { return static_cast<Index>(parallels_.size() - 1); }
  // Returns the southern parallel of a row; parallel(num_rows()) is the north pole.
  [[nodiscard]] const Parallel& parallel(Index row) const { return parallels_[row]; }
  // Returns the latitudes of the lines between the rows of the grid, in degrees, from south to
  // north.
  [[nodiscard]] const std::vector<double>& latitudes() const { return latitudes_; }
  [[nodiscard]] Index first_row() const { return first_row_; }
  // Returns the cell in a column and row, or no_index if it is a filling one.
  [[nodiscard]] Index cell(Index column, Index row) const;
  struct ColumnAndRow {
    Index column;
    Index row;
  };
  // Returns where a cell is.
  [[nodiscard]] ColumnAndRow place_of(Index cell) const;
  // Returns the area of a column in a row, in steradians, also for filling ones.
  [[nodiscard]] double area(Index column, Index row) const {
    return columns_[column].width * heights_[row];
  }
  // Returns the difference between the sines of a row's parallels.
  [[nodiscard]] double height(Index row) const { return heights_[row]; }
  // Returns the chord along a meridian from one of a row's parallels to the other.
  [[nodiscard]] double chord(Index row) const { return chords_[row]; }
  // Returns the point where the meridian `offset` radians east of a column's western meridian meets
  // the equator.
  [[nodiscard]] Point meridian(Index column, double offset) const;
  // Returns the point where a column's eastern meridian meets the equator.
  [[nodiscard]] Point eastern_meridian(Index column) const {
    return columns_[column + 1 < columns_.size() ? column + 1 : 0].west;
  }

  // The area of a cell, in steradians, and the length of its border, in radians.
  struct CellSize {
    double area;
    double length;
  };
  [[nodiscard]] CellSize size_of(Index cell) const;
  // Returns the area of each cell, in steradians.
  [[nodiscard]] std::vector<double> areas() const;
  [[nodiscard]] std::vector<Point> moments() const;
  // Returns the length of the border of each cell, in radians.
  [[nodiscard]] std::vector<double> lengths() const;
  // Appends the cells that share a side with a cell, in no order, and possibly twice.
  void append_neighbors(Index cell, std::vector<Index>& neighbors) const;

 private:
  void take_columns(std::vector<double> lon);
  void take_rows(std::vector<double> lat);
  [[nodiscard]] CellSize size_of(Index column, Index row) const;

  Index num_columns_of_grid_;
  Index num_rows_of_grid_;
  bool is_around_ = false;
  bool is_southward_ = false;  // the rows of the given grid lead from north to south
  bool is_westward_ = false;   // its columns lead from east to west
  Index first_row_ = 0;        // the first row that belongs to the grid
  std::vector<Lune> columns_;
  std::vector<Parallel> parallels_;
  std::vector<double> heights_;  // of each row, the difference of sines
  std::vector<double> chords_;
  std::vector<double> latitudes_;
};

// Returns the difference between the sines of two latitudes in degrees, to some units in the last place.
double rise_between(double low_deg, double high_deg);

// Returns the difference between the sines of two parallels, to some units in the last place.
double height_between(const PreparedGrid::Parallel& south, const PreparedGrid::Parallel& north);

// Returns the first moment, the integral of the unit vector, of the part of a row within a range of
// longitude. `height` is the height_between() the row's parallels, `width` the range in radians,
// and `run` the point of the equator at the range's eastern end minus that at its western end.
Point moment_of_row(const PreparedGrid::Parallel& south, const PreparedGrid::Parallel& north,
                    double height, double width, const Point& run);

// Returns the cells of a grid with great circles for sides, in the order of the grid.
CellRings rings_of(const LonLatGrid& grid);

}  // namespace rondel::overlay
