// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Assembles the rows of pieces that several threads compute, in the order of the cells' indices in
// the input.
//
// in    a function that returns the pieces of one cell
// out   PieceRows
// index rows: indices of the cells in the input; places: cells of the other subdivision in its own
//       order
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "exact/eft.h"
#include "overlay/pieces.h"
#include "system/row_assembly.h"
#include "system/stage_progress.h"

namespace rondel::overlay {

// The pieces of a block of cells, in the order of the cells.
struct RowBlock {
  std::vector<Index> sizes;  // the number of pieces of each cell
  // The column of each piece.
  std::vector<Index> columns;
  // The place of each piece; empty if sums of columns are not wanted.
  std::vector<Index> places;
  std::vector<double> areas;
  std::vector<Point> moments;
};

inline constexpr std::size_t cells_per_row_block = 1024;

// Returns the sums of the areas of all columns in double_double arithmetic. `names` gives the
// column of each place. The sums go from block to block in spatial order, so that memory is read
// and written in order.
inline std::vector<double> column_sums(std::span<const RowBlock> blocks,
                                       std::span<const Index> names) {
  std::vector<exact::DoubleDouble> sums(names.size());
  for (const RowBlock& block : blocks) {
    for (std::size_t k = 0; k < block.places.size(); ++k) {
      add_term(block.areas[k], sums[block.places[k]]);
    }
  }
  std::vector<double> result(names.size());
  for (std::size_t k = 0; k < names.size(); ++k) result[names[k]] = sums[k].hi + sums[k].lo;
  return result;
}

// Computes the pieces of all cells in parallel and returns them as rows. make(first, end) makes a
// callable for the cells [first, end). Its operator()(cell) returns the pieces of a cell that has a
// ring, each with `area` and `moment`, sorted by its column(piece). Its column(piece) must be
// names[place(piece)]; without names there are no sums of columns.
template <class Make>
PieceRows gathered_rows(const Subdivision& cells, std::span<const Index> names, bool has_moments,
                        const Execution& execution, const Make& make) {
  const std::size_t n = cells.num_cells();
  std::vector<RowBlock> blocks(system::num_pieces(n, cells_per_row_block));
  PieceRows result;
  result.row_sums.assign(n, 0);
  system::StageProgress progress(execution.progress, "cut", blocks.size());
  system::parallel_for(execution.threads, n, cells_per_row_block,
                       [&](std::size_t begin, std::size_t end) {
                         RowBlock& block = blocks[begin / cells_per_row_block];
                         auto maker = make(static_cast<Index>(begin), static_cast<Index>(end));
                         for (std::size_t c = begin; c < end; ++c) {
                           const auto cell = static_cast<Index>(c);
                           Index count = 0;
                           exact::DoubleDouble sum{};
                           if (cells.shapes[c] != Shape::empty) {
                             for (const auto& piece : maker(cell)) {
                               block.columns.push_back(maker.column(piece));
                               if (!names.empty()) block.places.push_back(maker.place(piece));
                               block.areas.push_back(piece.area);
                               if (has_moments) block.moments.push_back(piece.moment);
                               add_term(piece.area, sum);
                               ++count;
                             }
                           }
                           block.sizes.push_back(count);
                           result.row_sums[cells.names[c]] = sum.hi + sum.lo;
                         }
                         progress.step();
                       });
  if (!names.empty()) result.column_sums = column_sums(blocks, names);
  result.offsets = system::join_rows(
      execution.threads, n, std::move(blocks),
      [&](std::size_t b, const RowBlock&, std::size_t k) {
        return cells.names[b * cells_per_row_block + k];
      },
      system::JoinedColumn{&RowBlock::columns, result.columns},
      system::JoinedColumn{&RowBlock::areas, result.areas},
      system::JoinedColumn{&RowBlock::moments, result.moments});
  return result;
}

}  // namespace rondel::overlay
