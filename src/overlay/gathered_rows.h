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

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "exact/eft.h"
#include "overlay/pieces.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel::overlay {

// The pieces of a block of cells, in the order of the cells.
struct RowBlock {
  std::vector<Index> counts;  // the number of pieces of each cell
  // The column of each piece.
  std::vector<Index> columns;
  // The place of each piece.
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
// names[place(piece)].
template <class Make>
PieceRows gathered_rows(const Subdivision& cells, std::span<const Index> names, bool has_moments,
                        const Execution& execution, const Make& make) {
  const std::size_t n = cells.num_cells();
  std::vector<RowBlock> blocks(system::num_pieces(n, cells_per_row_block));
  PieceRows result;
  result.offsets.assign(n + 1, 0);
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
                               block.places.push_back(maker.place(piece));
                               block.areas.push_back(piece.area);
                               if (has_moments) block.moments.push_back(piece.moment);
                               add_term(piece.area, sum);
                               ++count;
                             }
                           }
                           block.counts.push_back(count);
                           result.offsets[cells.names[c] + std::size_t{1}] = count;
                           result.row_sums[cells.names[c]] = sum.hi + sum.lo;
                         }
                         progress.step();
                       });
  for (std::size_t i = 0; i < n; ++i) result.offsets[i + 1] += result.offsets[i];
  result.column_sums = column_sums(blocks, names);
  result.columns.resize(result.offsets[n]);
  result.areas.resize(result.offsets[n]);
  if (has_moments) result.moments.resize(result.offsets[n]);
  system::parallel_for(
      execution.threads, n, cells_per_row_block, [&](std::size_t begin, std::size_t end) {
        RowBlock block = std::move(blocks[begin / cells_per_row_block]);
        auto from = std::ptrdiff_t{0};
        for (std::size_t c = begin; c < end; ++c) {
          const auto to = static_cast<std::ptrdiff_t>(result.offsets[cells.names[c]]);
          const Index size = block.counts[c - begin];
          std::copy_n(block.columns.begin() + from, size, result.columns.begin() + to);
          std::copy_n(block.areas.begin() + from, size, result.areas.begin() + to);
          if (has_moments) {
            std::copy_n(block.moments.begin() + from, size, result.moments.begin() + to);
          }
          from += size;
        }
      });
  return result;
}

}  // namespace rondel::overlay
