// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The boundaries of the pieces into which the cells of a subdivision are cut by those of a cover.
//
// The boundary of a cell is a sequence of arcs, each in one cell of the cover (crossings.h). What of the
// cover's edges lies inside follows without a further decision: an edge that the boundary crosses on
// its way out of a cell goes inwards in the direction of its halfedge there, to the next crossing or
// to its end, and from there all other edges go on. The arcs with the cell b of the cover to their
// left bound the piece of b; edges of the cover bound two.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/crossings.h"
#include "overlay/subdivision.h"
#include "query/visited.h"
#include "rondel/types.h"

namespace rondel::overlay {

// From one point to another along a great circle.
struct PieceArc {
  Index left;   // the cell of the cover
  Index right;  // the same of an edge of the cover; no_index of the cell's boundary
  Index from;   // of points()
  Index to;
};

// Of the cells [first_cell, end_cell).
class ArcMaker {
 public:
  ArcMaker(const Subdivision& cells, const Subdivision& cover, Index first_cell, Index end_cell)
      : cells_(cells), cover_(cover), crossings_(cells, cover, first_cell, end_cell) {}

  // All arcs of a cell that has a ring: first those of its boundary, in order. The result lives until the
  // next call.
  std::span<const PieceArc> operator()(Index cell);
  [[nodiscard]] std::span<const Point> points() const { return points_; }
  // Which of the points are the corners of the last cell, in order.
  [[nodiscard]] std::span<const Index> corners() const { return corners_; }
  // Of the last cell: whether no corner of the cover seemed to be inside of it and outside, as it may where sides cross.
  [[nodiscard]] bool is_consistent() const { return is_consistent_; }

 private:
  // Where the boundary leaves a cell of the cover.
  struct Passage {
    Halfedge edge;  // the lower one of `out` and its twin
    Halfedge out;
    Halfedge by;  // of the cell
    Index point;  // of points_
  };

  void follow_boundary(Index cell);
  void sort_passages(bool is_convex);
  [[nodiscard]] bool is_before(const Passage& a, const Passage& b) const;
  void follow_inwards();
  void flood();
  [[nodiscard]] bool has_clear_ends() const;
  [[nodiscard]] bool has_corners_of_cover(Index cell);
  [[nodiscard]] double area_within(Index beyond) const;
  void take_all_edges();
  Index add_point(const Point& p) {
    points_.push_back(p);
    return static_cast<Index>(points_.size() - 1);
  }
  void add_edge(Halfedge h, Index from, Index to);
  void arrive(Halfedge h);
  [[nodiscard]] bool has_passage(Halfedge edge) const;
  static std::uint64_t digits_of(Halfedge edge) { return std::uint64_t{1} << edge % 64; }

  const Subdivision& cells_;
  const Subdivision& cover_;
  Crossings crossings_;
  std::vector<PieceArc> arcs_;
  std::vector<Point> points_;
  std::vector<Index> corners_;  // of points_
  std::vector<Passage> passages_;
  std::uint64_t passed_ = 0;        // digits_of() the edges that have passages
  std::vector<Halfedge> arrivals_;  // their ends are inside, and wait
  query::VisitedSet visited_;       // points of the cover
  std::vector<Point> ring_;
  bool is_consistent_ = true;
};

}  // namespace rondel::overlay
