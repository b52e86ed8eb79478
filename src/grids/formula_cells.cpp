// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/formula_cells.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "overlay/cell_set_data.h"
#include "overlay/single_cells.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::grids {
namespace {

// The rings of consecutive cells.
struct RingBlock {
  std::vector<Index> sizes;  // corners of each ring
  std::vector<Point> points;
};

// Returns some of the cells, with points of their own.
CellRings some_of(const CellRings& all, std::span<const Index> cells) {
  CellRings result;
  for (const Index cell : cells) {
    for (std::uint64_t ring = all.cells[cell]; ring < all.cells[cell + std::size_t{1}]; ++ring) {
      for (const Index corner : all.corners_of(ring)) {
        result.corners.push_back(static_cast<Index>(result.points.size()));
        result.points.push_back(all.points[corner]);
      }
      result.end_ring();
    }
    result.end_cell();
  }
  overlay::merge_equal_points(result);
  return result;
}

}  // namespace

CellRings rings_of(const GridFormula& grid, std::span<const Index> cells, unsigned threads) {
  if (const CellRings* const all = grid.stored()) return some_of(*all, cells);
  std::vector<RingBlock> blocks(system::num_pieces(cells.size(), overlay::cells_per_task));
  system::parallel_for(threads, cells.size(), overlay::cells_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         RingBlock& block = blocks[begin / overlay::cells_per_task];
                         for (std::size_t k = begin; k < end; ++k) {
                           const std::size_t before = block.points.size();
                           grid.append_ring(cells[k], block.points);
                           block.sizes.push_back(static_cast<Index>(block.points.size() - before));
                         }
                       });
  CellRings result;
  result.cells.reserve(cells.size() + 1);
  result.rings = system::join_rows(
      threads, cells.size(), std::move(blocks),
      [](std::size_t b, const RingBlock&, std::size_t k) {
        return b * overlay::cells_per_task + k;
      },
      system::JoinedColumn{&RingBlock::points, result.points});
  for (std::size_t k = 0; k < cells.size(); ++k) result.cells.push_back(k + 1);
  result.corners.resize(result.points.size());
  for (std::size_t k = 0; k < result.corners.size(); ++k) {
    result.corners[k] = static_cast<Index>(k);
  }
  overlay::merge_equal_points(result);
  return result;
}

CellSet cells_of(const GridFormula& grid, std::span<const Index> cells,
                 const Execution& execution) {
  CompressedRows<LonLatSide> sides;
  const CompressedRows<LonLatSide>* const stored = grid.stored_sides();
  if (stored != nullptr && stored->size() > 0) {
    for (const Index cell : cells) sides.append((*stored)[cell]);
  }
  return overlay::CellSetData::of_apart(rings_of(grid, cells, execution.threads), execution,
                                        std::move(sides), grid.equal_area());
}

}  // namespace rondel::grids
