// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/piece_boundaries.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exact/angles.h"
#include "exact/exact_sign.h"
#include "map/ring_area.h"

namespace rondel::overlay {
namespace {

// Compares two crossings along a great circle, each circle given by two points: positive if the
// circle pq meets the circle yz, in the latter's direction, before the circle rs does. Both cross
// it from right to left and within one arc of less than 180 degrees.
//
// With the normals N = y x z, M = p x q and M' = r x s it is the sign of N.(M x M'). Where that
// vanishes, it is the sign of its change w.(N x (M x M')) when the first circle is perturbed
// (perturbed_predicates.h).
Sign crossing_order(const Point& y, const Point& z, const Point& p, const Point& q, const Point& r,
                    const Point& s) {
  const auto sign_of = [&](const auto& value) {
    return exact::sign_of_sextic([&](const auto& step) {
      const Point o{};
      return value(cross(step(o, y), step(o, z)),
                   cross(cross(step(o, p), step(o, q)), cross(step(o, r), step(o, s))))
          .sign();
    });
  };
  Sign sign = sign_of([](const auto& n, const auto& m) { return dot(n, m); });
  if (sign == Sign::zero)
    sign = sign_of([](const auto& n, const auto& m) { return cross(n, m).x; });
  if (sign == Sign::zero)
    sign = sign_of([](const auto& n, const auto& m) { return cross(n, m).y; });
  if (sign == Sign::zero)
    sign = sign_of([](const auto& n, const auto& m) { return cross(n, m).z; });
  return sign;
}

}  // namespace

std::span<const BoundaryArc> PieceBoundaries::operator()(Index cell) {
  arcs_.clear();
  points_.clear();
  corners_.clear();
  passages_.clear();
  passed_ = 0;
  arrivals_.clear();
  visited_.clear();
  follow_boundary(cell);
  sort_passages(cells_.shapes[cell] == Shape::convex);
  follow_inwards();
  flood();
  is_consistent_ = cells_.shapes[cell] != Shape::other || has_clear_ends();
  if (passages_.empty() && has_all_edges_inside(cell)) take_all_edges();
  return arcs_;
}

// Appends the arcs of the cell's boundary and collects the passages.
void PieceBoundaries::follow_boundary(Index cell) {
  for (Index ring = cells_.cells[cell]; ring < cells_.cells[cell + 1]; ++ring) {
    const Halfedge end = cells_.rings[ring + 1];
    const auto first = static_cast<Index>(points_.size());
    for (Halfedge h = cells_.rings[ring]; h < end; ++h) {
      const Crossings::EdgeTrace& trace = crossings_.trace_of(h);
      const auto crossings = crossings_.of(trace);
      Index beyond = trace.start;
      Index from = add_point(cells_.origin(h));
      corners_.push_back(from);
      for (std::size_t k = 0; k < crossings.size(); ++k) {
        const EdgeCrossing& crossing = crossings[trace.is_backwards ? crossings.size() - 1 - k : k];
        const Halfedge twin = cover_.twins[crossing.out];
        const Halfedge out = trace.is_backwards ? twin : crossing.out;
        const Halfedge in = trace.is_backwards ? crossing.out : twin;
        const Index to = add_point(crossing.point);
        arcs_.push_back({beyond, no_index, from, to});
        passages_.push_back({std::min(out, in), out, h, to});
        passed_ |= bit_of(std::min(out, in));
        from = to;
        beyond = cover_.cell_of[in];
      }
      arcs_.push_back(
          {beyond, no_index, from, h + 1 == end ? first : static_cast<Index>(points_.size())});
    }
  }
}

// Sorts passages by edge, and those of an edge in the direction of its lower halfedge. An edge has
// two passages of a convex cell only if the boundary comes in by the first and goes out by the
// second.
void PieceBoundaries::sort_passages(bool is_convex) {
  std::ranges::sort(passages_, [&](const Passage& a, const Passage& b) {
    if (a.edge != b.edge) return a.edge < b.edge;
    if (is_convex) return a.out == a.edge && b.out != b.edge;
    return is_before(a, b);
  });
}

// True if passage a comes before b along their common edge.
bool PieceBoundaries::is_before(const Passage& a, const Passage& b) const {
  const auto end = [&](const Passage& passage) {
    const Index ring_end = *std::ranges::upper_bound(cells_.rings, passage.by);
    if (passage.by + 1 < ring_end) return passage.by + 1;
    return *(std::ranges::upper_bound(cells_.rings, passage.by) - 1);
  };
  if (a.by == b.by) return false;
  const Sign sign =
      crossing_order(cover_.origin(a.edge), cover_.end(a.edge), cells_.origin(a.by),
                     cells_.origin(end(a)), cells_.origin(b.by), cells_.origin(end(b)));
  // If the boundary leaves by the edge's own halfedge, it crosses the edge from left to right.
  const bool is_turned = (a.out == a.edge) != (b.out == b.edge);
  return sign == (is_turned ? Sign::negative : Sign::positive);
}

// Appends the parts of edges inside of the cell that begin or end at a passage: from passage to
// passage, or between a passage and an end of the edge.
void PieceBoundaries::follow_inwards() {
  for (std::size_t k = 0; k < passages_.size(); ++k) {
    const Passage& passage = passages_[k];
    if (passage.out != passage.edge) {  // the part before it is inside
      add_edge(passage.edge, add_point(cover_.origin(passage.edge)), passage.point);
      mark_end_inside(passage.out);
    } else if (k + 1 < passages_.size() && passages_[k + 1].edge == passage.edge) {
      add_edge(passage.edge, passage.point, passages_[k + 1].point);
      ++k;
    } else {
      add_edge(passage.edge, passage.point, add_point(cover_.end(passage.edge)));
      mark_end_inside(passage.out);
    }
  }
}

// Appends the edges that are reached from ends inside of the cell without crossing its boundary.
void PieceBoundaries::flood() {
  while (!arrivals_.empty()) {
    const Halfedge arrived = arrivals_.back();
    arrivals_.pop_back();
    const Halfedge first = cover_.twins[arrived];
    Halfedge h = first;
    do {
      const Halfedge edge = std::min(h, cover_.twins[h]);
      if (!has_passage(edge)) {
        if (h == edge) add_edge(h, add_point(cover_.origin(h)), add_point(cover_.end(h)));
        mark_end_inside(h);
      }
      h = cover_.twins[cover_.previous(h)];
    } while (h != first);
  }
}

// True if the crossings along each edge lead into the cell and out of it alternately, and no corner
// of the cover was found to be both inside and outside of the cell.
bool PieceBoundaries::has_clear_ends() const {
  for (std::size_t k = 0; k < passages_.size(); ++k) {
    const auto& [edge, out, by, point] = passages_[k];
    const bool comes_in = out == edge;  // in the direction of the edge
    const bool is_first = k == 0 || passages_[k - 1].edge != edge;
    const bool is_last = k + 1 == passages_.size() || passages_[k + 1].edge != edge;
    if (!is_last && comes_in == (passages_[k + 1].out == edge)) return false;
    if (is_first && comes_in && visited_.contains(cover_.corners[edge])) return false;
    if (is_last && !comes_in && visited_.contains(cover_.corners[cover_.next(edge)])) return false;
  }
  return true;
}

// True if the edges of the cover are inside of a cell none of whose sides crosses an edge. The
// edges are connected, so all of them are inside or none is, and each ring is inside of one cell of
// the cover. If the edges are outside, the areas to the left of the rings within these cells,
// negative for holes, add up to the area of the cell; otherwise they add up to that area minus the
// sphere's.
bool PieceBoundaries::has_all_edges_inside(Index cell) {
  if (cells_.shapes[cell] != Shape::other) return false;
  double inside_of_rings = 0;
  for (Index ring = cells_.cells[cell]; ring < cells_.cells[cell + 1]; ++ring) {
    cells_.copy_ring(ring, ring_);
    inside_of_rings += area_within(crossings_.trace_of(cells_.rings[ring]).start);
  }
  return cells_.area_of_other(cell) - inside_of_rings > 2 * std::numbers::pi;
}

// Returns the area to the left of ring_ within the cell of the cover that contains it, or minus the
// area to the right of it there. A cell of a cover has less than a hemisphere, so the same is true
// of one side of the ring within it. Where it is nearly a hemisphere, triangles at the cell's
// center are used, none of which contains the antipode of the center.
double PieceBoundaries::area_within(Index beyond) const {
  constexpr double surely_less = 2 * std::numbers::pi - 1e-3;
  const double area = map::area_on_left(ring_);
  if (std::abs(area) < surely_less) return area;
  double sum = 0;
  for (std::size_t k = 0; k < ring_.size(); ++k) {
    sum += exact::triangle_area(cover_.centers[beyond], ring_[k],
                                ring_[k + 1 < ring_.size() ? k + 1 : 0]);
  }
  return sum;
}

// Appends all edges of the cover.
void PieceBoundaries::take_all_edges() {
  for (Halfedge h = 0; h < cover_.num_halfedges(); ++h) {
    if (h < cover_.twins[h]) {
      add_edge(h, add_point(cover_.origin(h)), add_point(cover_.end(h)));
    }
  }
}

void PieceBoundaries::add_edge(Halfedge h, Index from, Index to) {
  arcs_.push_back({cover_.cell_of[h], cover_.cell_of[cover_.twins[h]], from, to});
}

// Marks the corner of the cover at the end of a halfedge as inside of the cell.
void PieceBoundaries::mark_end_inside(Halfedge h) {
  if (visited_.insert(cover_.corners[cover_.next(h)])) arrivals_.push_back(h);
}

bool PieceBoundaries::has_passage(Halfedge edge) const {
  if ((passed_ & bit_of(edge)) == 0) return false;
  constexpr std::size_t few = 12;
  if (passages_.size() <= few) {
    return std::ranges::any_of(passages_,
                               [edge](const Passage& passage) { return passage.edge == edge; });
  }
  return std::ranges::binary_search(passages_, edge, {}, &Passage::edge);
}

}  // namespace rondel::overlay
