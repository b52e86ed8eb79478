// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Cells as polygons with corners of their own: what files hold, and what partitions of the sphere
/// are made of.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondel/types.h"

namespace rondel {

/// Cells in compressed rows. Cell i has the rings `cells[i] ... cells[i+1]-1`; ring r the corners
/// `corners[rings[r]] ... corners[rings[r+1]-1]`, positions in `points`, the first one not repeated.
///
/// 1. Consecutive corners are joined by the shorter arc of a great circle.
/// 2. The interior is to the left: outer rings are counterclockwise seen from outside, holes
///    clockwise. A cell may have several outer rings, and rings may touch in corners.
/// 3. Cells that share an edge name the same two points if a walk is to cross it.
/// 4. A cell without a ring is the whole sphere if `whole` names it, and empty otherwise.
struct CellRings {
  std::vector<std::uint64_t> cells = {0};  ///< number of cells + 1
  std::vector<std::uint64_t> rings = {0};  ///< number of rings + 1
  std::vector<Index> corners;
  std::vector<Point> points;  ///< unit vectors
  std::vector<Index> whole =
      {};  ///< the cells that are the whole sphere, increasing; they have no rings

  [[nodiscard]] std::size_t num_cells() const { return cells.size() - 1; }
  /// Whether a cell is the whole sphere.
  [[nodiscard]] bool is_whole(std::size_t cell) const {
    return std::ranges::binary_search(whole, cell);
  }
};

}  // namespace rondel
