// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The areas and first moments of the pieces into which cells are cut by those of a cover.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/subdivision.h"
#include "rondel/types.h"

namespace rondel::overlay {

// In compressed rows by the cells' names, columns increasing.
struct PieceRows {
  std::vector<std::uint64_t> offsets = {0};
  std::vector<Index> columns;
  std::vector<double> areas;
  std::vector<Point> moments;  // empty unless asked for
  // Of the areas, in twice the precision and then rounded; empty where find_sums() is still to be called.
  std::vector<double> row_sums;
  std::vector<double> column_sums;
};

void find_sums(PieceRows& pieces, std::size_t num_columns);

// The sums that the pieces of each cell should have, by name.
struct CellSizes {
  std::span<const double> areas;
  std::span<const double> lengths;  // of their borders
};

// Pieces not larger than what rounding of their corners may be are left out. Throws InvalidInput if those of a cell do not
// add up to it (require_sum()).
PieceRows pieces(const Subdivision& cells, const CellSizes& sizes, const Subdivision& cover,
                 bool has_moments, const Execution& execution);

// The same of two that are parts of the sphere. Throws InvalidInput where cells of `others` overlap.
PieceRows pieces_of_parts(const Subdivision& cells, const CellSizes& sizes,
                          const Subdivision& others, bool has_moments, const Execution& execution);

// With rows and columns exchanged.
PieceRows transposed(const PieceRows& pieces, std::size_t num_columns);

}  // namespace rondel::overlay
