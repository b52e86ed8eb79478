// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the areas and first moments of the pieces into which cells are cut by other cells.
//
// in    two subdivisions
// out   PieceRows
// index rows: indices of the cells in the input; columns: indices of the other cells in their input
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/subdivision.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The pieces of all cells, in compressed rows: row i has the pieces of cell i, with ascending
// columns.
struct PieceRows {
  std::vector<std::uint64_t> offsets = {0};  // one more than rows
  std::vector<Index> columns;                // the other cell, by its index in the input
  std::vector<double> areas;                 // steradians
  std::vector<Point> moments;                // integrals of the unit vector; empty unless asked for
  // The sums of the areas of rows and columns, computed in double_double arithmetic and rounded.
  // They are empty until find_sums() is called, unless the function that made the pieces knows
  // them.
  std::vector<double> row_sums;
  std::vector<double> column_sums;

  void end_row() { offsets.push_back(columns.size()); }
};

// Computes row_sums and column_sums, or row_sums alone.
void find_sums(PieceRows& pieces, std::size_t num_columns);
void find_row_sums(PieceRows& pieces);

// The area and the length of the border of each cell, by its index in the input.
struct CellSizes {
  std::span<const double> areas;
  std::span<const double> lengths;  // radians
};

// Returns the pieces of `cells` in the cells of a cover. Pieces not larger than what rounding of
// their corners can make are dropped. Throws InvalidInput if the pieces of a cell do not add up to
// it (require_sum()).
PieceRows pieces(const Subdivision& cells, const CellSizes& sizes, const Subdivision& cover,
                 bool has_moments, const Execution& execution);

// Returns the pieces of `cells` in `others`, which need not cover the sphere. Throws InvalidInput
// if cells of `others` overlap.
PieceRows pieces_of_parts(const Subdivision& cells, const CellSizes& sizes,
                          const Subdivision& others, bool has_moments, const Execution& execution);

// Returns the pieces with rows and columns exchanged.
PieceRows transposed(const PieceRows& pieces, std::size_t num_columns);

}  // namespace rondel::overlay
