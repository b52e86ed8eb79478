// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Grids of meridians and parallels, prepared for an overlay.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/vector.h"
#include "rondel/partition.h"
#include "rondel/types.h"

namespace rondel::overlay {

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
    return columns_[column].width * (parallels_[row + 1].sine - parallels_[row].sine);
  }
  // Where the meridian `offset` radians east of a column's western one meets the equator.
  [[nodiscard]] Point meridian(Index column, double offset) const;
  [[nodiscard]] Point eastern_meridian(Index column) const {
    return columns_[column + 1 < columns_.size() ? column + 1 : 0].west;
  }

  // By cell.
  [[nodiscard]] std::vector<double> areas() const;
  [[nodiscard]] std::vector<Point> moments() const;
  // Of borders: of the parallels as if they were at the equator.
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
  std::vector<double> latitudes_;
};

// The integral of q over the part of a row where q's longitude is in a range: `run` is the difference of the eastern
// and the western end of the range, on the equator.
Point moment_of_row(const Graticule::Parallel& south, const Graticule::Parallel& north,
                    double width, const Point& run);

// The cells of a grid with sides on great circles, named as those of the grid.
CellRings rings_of(const LonLatGrid& grid);

}  // namespace rondel::overlay
