// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes the dual of a mesh of cells: dual_cells().
//
// in    cells as rings of corners
// out   rings of cells around corners
// index points and cells as given
//
// At a corner, each of its cells has the corner before and the one after it. The cells around it are
// a ring if each begins where another one ends.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "arrangement/ring_arrays.h"
#include "overlay/barycentric.h"
#include "rondel/error.h"
#include "rondel/native_weights.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

// A cell at a corner: counterclockwise seen from outside, it is between the sides to these corners.
struct CellAtCorner {
  Index cell;
  Index after;   // the corner that follows in the ring
  Index before;  // the corner before
};

// Returns the cells at each point.
CompressedRows<CellAtCorner> cells_at_points(const CellRings& cells) {
  system::RowPlaces places(cells.points.size());
  for (const Index corner : cells.corners) places.count(corner);
  CompressedRows<CellAtCorner> rows;
  rows.values.resize(places.sum());
  for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) {
    for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
      const std::span<const Index> given = cells.corners_of(r);
      std::vector<Index> ring(given.begin(), given.end());
      turn_left(cells.points, ring);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        rows.values[places.place(ring[k])] = {static_cast<Index>(cell),
                                              ring[k + 1 < ring.size() ? k + 1 : 0],
                                              ring[k > 0 ? k - 1 : ring.size() - 1]};
      }
    }
  }
  rows.offsets = std::move(places).offsets();
  return rows;
}

// Returns the cells around a point counterclockwise, or nothing if they do not close around it.
std::vector<Index> ring_around(std::span<const CellAtCorner> at) {
  std::vector<Index> ring;
  if (at.size() < 3) return ring;
  std::size_t here = 0;
  do {
    ring.push_back(at[here].cell);
    // The next cell begins at the side where this one ends.
    std::size_t next = at.size();
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (at[k].after != at[here].before) continue;
      if (next != at.size()) return {};  // cells that overlap
      next = k;
    }
    if (next == at.size()) return {};
    here = next;
  } while (here != 0 && ring.size() < at.size());
  // All cells are in one ring, which ends where it began.
  if (here != 0 || ring.size() != at.size()) return {};
  return ring;
}

}  // namespace

CellRings dual_cells(const CellRings& cells, std::span<const Point> centers) {
  arrangement::validate_rings(cells);
  if (centers.size() != cells.num_cells()) {
    throw InvalidInput(std::to_string(centers.size()) + " centers for " +
                       std::to_string(cells.num_cells()) + " cells");
  }
  CellRings dual;
  dual.points.assign(centers.begin(), centers.end());
  const CompressedRows<CellAtCorner> at = cells_at_points(cells);
  for (std::size_t point = 0; point < at.size(); ++point) {
    const std::vector<Index> ring = ring_around(at[point]);
    if (ring.empty()) continue;
    dual.append_ring(ring);
    dual.end_cell();
  }
  return dual;
}

}  // namespace rondel
