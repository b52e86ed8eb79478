// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The boundaries of the pieces into which the cells of a subdivision are cut by the cells of a
// cover.
//
// in    a subdivision and a cover, which is perturbed (perturbed_predicates.h)
// out   for each cell the arcs that bound its pieces, each with the cells of the cover beside it
// index cells in the spatial orders of the subdivision and of the cover; points of one cell, from 0
//
// The boundary of a cell is a sequence of arcs, each in one cell of the cover (crossings.h). It
// determines which parts of the cover's edges are inside of the cell. Where the boundary leaves a
// cell of the cover by one of its halfedges, that edge leads into the cell in the direction of the
// halfedge. It goes on to the next crossing with the boundary, or else to its end: this corner of
// the cover is then inside of the cell, and all other edges go on from there. Two decisions are
// left: the order of crossings along an edge, if the cell is not convex (is_before()), and, if the
// boundary crosses no edge at all, whether the edges are inside (has_all_edges_inside()).
//
// The arcs with the cell b of the cover to their left bound the piece in b; edges of
// the cover bound two pieces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/crossings.h"
#include "overlay/subdivision.h"
#include "query/visited.h"
#include "rondel/types.h"

namespace rondel::overlay {

// An arc of a great circle that bounds a piece.
struct BoundaryArc {
  Index left;  // the cell of the cover to the left
  // For an arc of an edge of the cover, its cell to the right; no_index for an arc of the cell's
  // boundary.
  Index right;
  Index from;  // index into points()
  Index to;
};

// Traces the boundaries of the pieces of the cells [first_cell, end_cell).
class PieceBoundaries {
 public:
  PieceBoundaries(const Subdivision& cells, const Subdivision& cover, Index first_cell,
                  Index end_cell)
      : cells_(cells), cover_(cover), crossings_(cells, cover, first_cell, end_cell) {}

  // Returns all arcs of a cell that has a ring. The arcs of the cell's boundary come first, in
  // order. The result is valid until the next call.
  std::span<const BoundaryArc> operator()(Index cell);
  [[nodiscard]] std::span<const Point> points() const { return points_; }
  // Returns the corners of the last cell, in order, as indices into points().
  [[nodiscard]] std::span<const Index> corners() const { return corners_; }
  // False if a corner of the cover seemed to be both inside and outside of the last cell, as
  // happens if sides of the cell cross.
  [[nodiscard]] bool is_consistent() const { return is_consistent_; }

 private:
  // A place where the boundary leaves a cell of the cover.
  struct Passage {
    Halfedge edge;  // the lower one of `out` and its twin
    // The halfedge of the cover by which the boundary leaves.
    Halfedge out;
    Halfedge by;  // the halfedge of the cell that crosses
    Index point;  // the crossing, an index into points_
  };

  void follow_boundary(Index cell);
  void sort_passages(bool is_convex);
  [[nodiscard]] bool is_before(const Passage& a, const Passage& b) const;
  void follow_inwards();
  void flood();
  [[nodiscard]] bool has_clear_ends() const;
  [[nodiscard]] bool has_all_edges_inside(Index cell);
  [[nodiscard]] double area_within(Index beyond) const;
  void take_all_edges();
  // Adds a point to those of the cell, and returns its index.
  Index add_point(const Point& p) {
    points_.push_back(p);
    return static_cast<Index>(points_.size() - 1);
  }
  void add_edge(Halfedge h, Index from, Index to);
  void mark_end_inside(Halfedge h);
  [[nodiscard]] bool has_passage(Halfedge edge) const;
  static std::uint64_t bit_of(Halfedge edge) { return std::uint64_t{1} << edge % 64; }

  const Subdivision& cells_;
  const Subdivision& cover_;
  Crossings crossings_;
  std::vector<BoundaryArc> arcs_;
  std::vector<Point> points_;
  std::vector<Index> corners_;  // indices into points_
  std::vector<Passage> passages_;
  std::uint64_t passed_ = 0;        // the bits bit_of() of all edges with passages
  std::vector<Halfedge> arrivals_;  // halfedges whose ends are inside and are still to be visited
  query::VisitedSet visited_;       // the points of the cover whose edges were taken
  std::vector<Point> ring_;
  bool is_consistent_ = true;
};

}  // namespace rondel::overlay
