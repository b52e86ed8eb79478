// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where the edges of cells cross those of a cover.
#pragma once

#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

#include "overlay/subdivision.h"
#include "rondel/types.h"
#include "system/large_vector.h"

namespace rondel::overlay {

// Where an edge leaves a cell of the cover.
struct EdgeCrossing {
  Halfedge out;  // of the cover
  Point point;   // rounded
};

class Crossings {
 public:
  Crossings(const Subdivision& cells, const Subdivision& cover, const Execution& execution);

  // Of a halfedge.
  struct EdgeTrace {
    Index start;  // the cover's cell at its origin
    Index block;
    Index first;
    Index count;
    bool is_backwards;  // the crossings are those of its twin
  };
  [[nodiscard]] const EdgeTrace& trace(Halfedge h) const { return traces_[h]; }
  [[nodiscard]] std::span<const EdgeCrossing> of(const EdgeTrace& trace) const {
    return std::span(blocks_[trace.block]).subspan(trace.first, trace.count);
  }

 private:
  static constexpr std::size_t cells_per_block = 1024;
  void trace_block(std::size_t block, const Subdivision& cover);

  const Subdivision& cells_;
  // By points of the cells: the cover's cells, as far as known. Whoever finds one finds the same.
  std::vector<std::atomic<Index>> known_;
  std::vector<std::vector<EdgeCrossing>> blocks_;  // of so many cells
  LargeVector<EdgeTrace> traces_;
};

}  // namespace rondel::overlay
