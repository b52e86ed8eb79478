// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rows of pieces, made by threads, put together in the order of the cells' names.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "overlay/pieces.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel::overlay {

// make(first, end) makes what the work on these cells needs; of it operator()(cell) gives pieces, with `area` and `moment`, in the order of
// column(piece), of a cell that has a ring.
template <class Make>
PieceRows gathered_rows(const Subdivision& cells, bool has_moments, const Execution& execution,
                        const Make& make) {
  constexpr std::size_t cells_per_block = 1024;
  struct RowBlock {
    std::vector<Index> counts;  // of each cell
    std::vector<Index> columns;
    std::vector<double> areas;
    std::vector<Point> moments;
  };
  const std::size_t n = cells.num_cells();
  std::vector<RowBlock> blocks(system::num_pieces(n, cells_per_block));
  PieceRows result;
  result.offsets.assign(n + 1, 0);
  system::StageProgress progress(execution.progress, "cut", blocks.size());
  system::parallel_for(execution.threads, n, cells_per_block,
                       [&](std::size_t begin, std::size_t end) {
                         RowBlock& block = blocks[begin / cells_per_block];
                         auto maker = make(static_cast<Index>(begin), static_cast<Index>(end));
                         for (std::size_t c = begin; c < end; ++c) {
                           const auto cell = static_cast<Index>(c);
                           Index count = 0;
                           if (cells.shapes[c] != Shape::empty) {
                             for (const auto& piece : maker(cell)) {
                               block.columns.push_back(maker.column(piece));
                               block.areas.push_back(piece.area);
                               if (has_moments) block.moments.push_back(piece.moment);
                               ++count;
                             }
                           }
                           block.counts.push_back(count);
                           result.offsets[cells.names[c] + std::size_t{1}] = count;
                         }
                         progress.step();
                       });
  for (std::size_t i = 0; i < n; ++i) result.offsets[i + 1] += result.offsets[i];
  result.columns.resize(result.offsets[n]);
  result.areas.resize(result.offsets[n]);
  if (has_moments) result.moments.resize(result.offsets[n]);
  system::parallel_for(
      execution.threads, n, cells_per_block, [&](std::size_t begin, std::size_t end) {
        RowBlock block = std::move(blocks[begin / cells_per_block]);
        std::size_t from = 0;
        for (std::size_t c = begin; c < end; ++c) {
          const std::size_t to = result.offsets[cells.names[c]];
          const std::size_t size = block.counts[c - begin];
          std::copy_n(block.columns.begin() + static_cast<std::ptrdiff_t>(from), size,
                      result.columns.begin() + static_cast<std::ptrdiff_t>(to));
          std::copy_n(block.areas.begin() + static_cast<std::ptrdiff_t>(from), size,
                      result.areas.begin() + static_cast<std::ptrdiff_t>(to));
          if (has_moments) {
            std::copy_n(block.moments.begin() + static_cast<std::ptrdiff_t>(from), size,
                        result.moments.begin() + static_cast<std::ptrdiff_t>(to));
          }
          from += size;
        }
      });
  return result;
}

}  // namespace rondel::overlay
