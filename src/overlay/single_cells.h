// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Operations on single cells: extraction, complement, concatenation. A single cell is a CellRings
// with one cell. Also the extraction of several cells.
//
// index cells and rings: as in the CellRings that they belong to (rings counted over all cells)
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Returns the corners of a ring.
std::vector<Point> points_of_ring(const CellRings& cells, std::uint64_t ring);
// Returns one of the cells, with points of its own.
CellRings one_cell(const CellRings& cells, Index cell);
// Returns the cells from `first` to before `end`, with the points that they use.
CellRings cells_between(const CellRings& cells, std::size_t first, std::size_t end);
// Returns the complement of a single cell. The complement of the whole sphere has no rings.
CellRings beyond_cell(CellRings one);
// True if a single cell is not empty.
[[nodiscard]] bool has_any(const CellRings& one);
// Appends a single cell to `all`, with points of its own.
void append(const CellRings& one, CellRings& all);
// Merges points that are equal bit by bit, so that cells share their common sides.
void merge_equal_points(CellRings& cells);

}  // namespace rondel::overlay
