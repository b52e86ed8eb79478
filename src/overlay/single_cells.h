// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Operations on single cells: extraction, complement, concatenation. A single cell is a CellRings
// with one cell. Also the extraction of several cells.
//
// index cells and rings: as in the CellRings that they belong to (rings counted over all cells)
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/types.h"
#include "system/distinct.h"

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
// Appends a ring with points of its own, which the next end of a cell takes.
void append_ring_of(std::span<const Point> points, CellRings& cells);
// Appends a single cell to `all`, with points of its own.
void append(const CellRings& one, CellRings& all);
// Merges points that are equal bit by bit, so that cells share their common sides.
void merge_equal_points(CellRings& cells);

// Appends single cells one after the other as append() does and merges their points as
// merge_equal_points() does. Where most cells are some of a set that shares its points, most points
// are found by their numbers.
class MergedCells {
 public:
  // The points of the set, if there is one, are different and in the order of their coordinates.
  explicit MergedCells(const CellRings& set, std::size_t num_others);

  // Appends a cell of the set, with its points in the order of its corners.
  void append_of_set(Index cell);
  // Appends a cell that is not of the set, with its points in their order.
  void append(const CellRings& one);
  // Appends a cell that is not of the set, with its points in the order of its corners.
  void append_by_corners(const CellRings& one);

  // Returns the cells. No cell may be appended any more.
  [[nodiscard]] CellRings made() { return std::move(made_); }

 private:
  [[nodiscard]] Index number(const Point& point);

  const CellRings& set_;
  CellRings made_;
  std::vector<Index> of_set_;     // of each point of the set, or no_index
  std::vector<Index> of_others_;  // of each other point
  std::vector<Point> others_;
  system::KnownValues<Point> known_;
};

}  // namespace rondel::overlay
