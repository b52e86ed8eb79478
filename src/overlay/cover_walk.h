// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Walks along an arc through the cells of a cover. Which edges it crosses, and in which order, is decided
// exactly, with the cover turned as signs.h says.
#pragma once

#include "overlay/signs.h"
#include "overlay/subdivision.h"

namespace rondel::overlay {

class CoverWalk {
 public:
  explicit CoverWalk(const Subdivision& cover) : cover_(cover) {}

  // From line.from() in `cell` to line.to(), whose cell it returns. Calls cross(h, edge) for each
  // halfedge by which a cell is left, in order.
  template <class Cross>
  Index operator()(const TracedLine& line, Index cell, const Cross& cross) const {
    if (cover_.num_halfedges() == 0 || line.is_point()) return cell;
    Halfedge in = no_index;  // the halfedge by which the cell was entered
    for (;;) {
      const Halfedge out = cover_.shapes[cell] == Shape::convex ? way_out(line, cell, in)
                                                                : way_out_of_star(line, cell, in);
      if (out == no_index) return cell;
      const CoverEdge edge(cover_.origin(out), cover_.end(out));
      if (edge.is_left(line.to())) return cell;
      cross(out, edge);
      in = cover_.twins[out];
      cell = cover_.cell_of[in];
    }
  }

 private:
  // The halfedge whose origin is right of the line and whose end is left of it.
  [[nodiscard]] Halfedge way_out(const TracedLine& line, Index cell, Halfedge in) const {
    const Index begin = cover_.begin_of(cell);
    const Index end = cover_.end_of(cell);
    const auto next = [&](Halfedge h) { return h + 1 == end ? begin : h + 1; };
    Halfedge h = in;
    if (in == no_index) {
      h = begin;
      while (line.is_left(cover_.origin(h))) h = next(h);
    } else {
      h = next(in);  // its origin is right
    }
    Halfedge after = next(h);
    while (!line.is_left(cover_.origin(after))) {
      h = after;
      after = next(h);
    }
    return h;
  }

  // The same, or no_index where the line ends before.
  [[nodiscard]] Halfedge way_out_of_star(const TracedLine& line, Index cell, Halfedge in) const;

  const Subdivision& cover_;
};

}  // namespace rondel::overlay
