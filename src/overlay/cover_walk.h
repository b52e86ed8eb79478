// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Walks along an arc through the cells of a cover. Which edges it crosses, and in which order, is decided
// exactly, with the cover turned as signs.h says.
#pragma once

#include <algorithm>
#include <bit>

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
  static constexpr Index most_at_once = 8;  // corners: most cells of diagrams have no more

  // The halfedge whose origin is right of the line and whose end is left of it.
  [[nodiscard]] Halfedge way_out(const TracedLine& line, Index cell, Halfedge in) const {
    const Index begin = cover_.begin_of(cell);
    const Index size = cover_.end_of(cell) - begin;
    if (size <= most_at_once) {
      // A bit for each corner, without a branch: which way it goes cannot be guessed.
      unsigned left = 0;
      unsigned sure = 0;
      for (Index k = 0; k < most_at_once; ++k) {
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

  // The halfedge of a star whose triangle with the center has p.
  [[nodiscard]] Halfedge halfedge_before(const Point& p, Index cell) const;
  // As way_out() of a star, or no_index where the line ends before.
  [[nodiscard]] Halfedge way_out_of_star(const TracedLine& line, Index cell, Halfedge in) const;

  const Subdivision& cover_;
};

}  // namespace rondel::overlay
