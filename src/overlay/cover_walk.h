// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Walks along an arc through the cells of a cover.
//
// in    an arc that is not perturbed, and the cell of the cover that has its start
// out   the edges of the cover that the arc crosses, in order, and the cell that has its end
// index cells and halfedges of the cover
//
// All decisions are exact, with the cover perturbed (perturbed_predicates.h).
#pragma once

#include <algorithm>
#include <bit>

#include "overlay/perturbed_predicates.h"
#include "overlay/subdivision.h"

namespace rondel::overlay {

class CoverWalk {
 public:
  explicit CoverWalk(const Subdivision& cover) : cover_(cover) {}

  // Walks from line.from(), which is in `cell`, to line.to(), and returns the cell of the latter, or
  // no_index if the walk leaves a cover of a part of the sphere.
  // Calls cross(h, edge) for each halfedge h by which the walk leaves a cell, in order; `edge` is
  // the same halfedge as a CoverEdge.
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
      if (in == no_index) return no_index;
      cell = cover_.cell_of[in];
    }
  }

 private:
  // The corners that are tested at once: most cells of diagrams have no more.
  static constexpr Index max_at_once = 8;

  // Returns the halfedge by which the line leaves a convex cell: its origin is right of the line
  // and its end is left of it. `in` is the halfedge by which the line entered the cell, or
  // no_index.
  [[nodiscard]] Halfedge way_out(const TracedLine& line, Index cell, Halfedge in) const {
    const Index begin = cover_.begin_of(cell);
    const Index size = cover_.end_of(cell) - begin;
    if (size <= max_at_once) {
      // One bit for each corner is computed without a branch, which would be unpredictable.
      unsigned left = 0;
      unsigned sure = 0;
      for (Index k = 0; k < max_at_once; ++k) {
        const double value = line.rough_side(cover_.origin(begin + std::min(k, size - 1)));
        sure |= static_cast<unsigned>(line.is_sure(value)) << k;
        left |= static_cast<unsigned>(value > 0) << k;
      }
      const unsigned all = (1U << size) - 1;
      left &= sure & all;
      for (unsigned unsure = all & ~sure; unsure != 0; unsure &= unsure - 1) {
        const auto k = static_cast<Index>(std::countr_zero(unsure));
        left |= static_cast<unsigned>(line.is_left_nearby(cover_.origin(begin + k))) << k;
      }
      const unsigned left_ends = left >> 1 | (left & 1) << (size - 1);
      return begin + static_cast<Index>(std::countr_zero(left_ends & ~left));
    }
    return way_out_by_search(line, cell, in);
  }
  [[nodiscard]] Halfedge way_out_by_search(const TracedLine& line, Index cell, Halfedge in) const;

  // Returns the halfedge of a cell of Shape::star whose triangle with the cell's center contains p.
  [[nodiscard]] Halfedge halfedge_before(const Point& p, Index cell) const;
  // Returns the halfedge by which the line leaves a cell of Shape::star, or no_index if the line
  // ends in the cell.
  [[nodiscard]] Halfedge way_out_of_star(const TracedLine& line, Index cell, Halfedge in) const;

  const Subdivision& cover_;
};

}  // namespace rondel::overlay
