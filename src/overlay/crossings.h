// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where the edges of cells cross those of a cover.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "overlay/subdivision.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Where an edge leaves a cell of the cover.
struct EdgeCrossing {
  Halfedge out;  // of the cover
  Point point;   // rounded
};

// Of the edges of some cells, [first_cell, end_cell), whichever others they are together with.
class Crossings {
 public:
  Crossings(const Subdivision& cells, const Subdivision& cover, Index first_cell, Index end_cell);

  struct EdgeTrace {
    Index start;  // the cover's cell at its origin
    Index first;
    Index count;
    bool is_backwards;  // the crossings are those of its twin
  };
  // Of a halfedge of these cells.
  [[nodiscard]] const EdgeTrace& trace_of(Halfedge h) const { return traces_[h - first_]; }
  [[nodiscard]] std::span<const EdgeCrossing> of(const EdgeTrace& trace) const {
    return std::span(crossings_).subspan(trace.first, trace.count);
  }

 private:
  Halfedge first_;
  std::vector<EdgeTrace> traces_;
  std::vector<EdgeCrossing> crossings_;
};

}  // namespace rondel::overlay
