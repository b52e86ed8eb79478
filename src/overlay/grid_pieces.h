// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the intersections of cells with the cells of a grid of meridians and parallels.
//
// in    cells of any shape, or another grid
// out   PieceRows: areas and first moments
// index rows: indices of the cells in the input; columns: cells of the grid
#pragma once

#include <vector>

#include "overlay/cell_set_data.h"
#include "overlay/pieces.h"
#include "overlay/prepared_grid.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Returns the pieces of all cells. Throws InvalidInput if the pieces of a cell do not add up to it
// (require_sum()). The sums of columns are left out on request: a grid may have very many.
PieceRows pieces(const CellSetData& cells, const PreparedGrid& grid, bool has_moments,
                 const Execution& execution, bool has_column_sums = true);

// The pieces of the cells of one grid in the cells of another.
class GridOverlay {
 public:
  GridOverlay(const PreparedGrid& rows, const PreparedGrid& columns);

  // Returns the pieces of the cells from `first` to before `end`, which are rows from 0 on.
  [[nodiscard]] PieceRows pieces(Index first, Index end, bool has_moments) const;

 private:
  // The range of longitude that a column shares with a column of the other grid.
  struct LonRange {
    Index column;
    double width;
    Point run;
  };
  // The range of latitude that a row shares with a row of the other grid.
  struct LatRange {
    Index row;
    PreparedGrid::Parallel south;
    PreparedGrid::Parallel north;
    double height;
  };
  // The intersection of a cell with a cell of the other grid.
  struct BoxPiece {
    Index cell;
    double area;
    Point moment;
  };
  // A column, or a row, of each grid, and the range that they share, in degrees from `low` to
  // `high`.
  struct LineOverlap {
    Index first;
    Index second;
    double low;
    double high;
  };

  static void add_overlap(const LineOverlap& overlap, std::vector<LineOverlap>& overlaps);
  static std::vector<LineOverlap> shared_columns(const PreparedGrid& a, const PreparedGrid& b);
  static std::vector<LineOverlap> shared_rows(const PreparedGrid& a, const PreparedGrid& b);
  static LonRange range_of(const LineOverlap& overlap, const PreparedGrid& grid);
  static LatRange range_of(const LineOverlap& overlap, const PreparedGrid& grid,
                           const PreparedGrid& other);
  static void append_row(const std::vector<BoxPiece>& row, bool has_moments, PieceRows& result);

  const PreparedGrid& columns_;
  // For each column, and for each row, of the given grid, what it shares with those of the other.
  std::vector<std::vector<LonRange>> along_;
  std::vector<std::vector<LatRange>> across_;
};

}  // namespace rondel::overlay
