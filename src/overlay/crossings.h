// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes where the edges of cells cross the edges of a cover.
//
// in    a subdivision, a range of its cells, and a cover
// out   for each halfedge of these cells, the cover's cell at its origin and all crossings in order
// index cells and halfedges, in the spatial order of the subdivision that they belong to: `out` and
//       `start` are of the cover, all others of the subdivision; `first` and `count` count
//       crossings
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "overlay/subdivision.h"
#include "rondel/types.h"

namespace rondel::overlay {

// A crossing: an edge leaves a cell of the cover.
struct EdgeCrossing {
  Halfedge out;  // the halfedge of the cover that is crossed, of the cell that is left
  Point point;   // rounded
};

// The crossings of the edges of the cells [first_cell, end_cell). The result for an edge does not
// depend on the range.
class Crossings {
 public:
  Crossings(const Subdivision& cells, const Subdivision& cover, Index first_cell, Index end_cell);

  // The crossings of one halfedge, as a range of all crossings.
  struct EdgeTrace {
    Index start;  // the cover's cell at its origin
    Index first;
    Index count;
    bool is_backwards;  // true if the crossings are those of the twin, in reverse order
  };
  // Returns the trace of a halfedge of these cells.
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
