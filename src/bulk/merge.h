// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Two triangulations that a great circle separates become one (Guibas and Stolfi, ACM Trans. Graph.
// 4, 1985): the conquest of divide and conquer.
//
//      .----.   .----.      A merge finds the lower common tangent (l, r) of the outer boundaries
//     |    x-\-/      |     of L and R, and sews upwards from it. Each step tries the first
//     | L   \ r'  R   |     neighbors of l and r above the edge (l, r), deletes the edges to
//     |      l-r      |     those in front of which another one lies, and adds the edge that
//      '----'   '----'      closes the lower face: (l, r') or (x, r).
//
// in    two parts of a graph, each by an edge of its outer boundary, and the sites to ask
// out   one part, or that this does not work
// index local sites and halfedges of the graph
//
// docs/theory/blocks.md shows that this holds for weighted sites as well: the cells of the power
// diagrams of L and R meet in one chain, and what lies behind it is never met again.
#pragma once

#include <array>
#include <tuple>

#include "bulk/collinear.h"
#include "bulk/merge_step.h"
#include "bulk/plane_graph.h"

namespace rondel::bulk {

// An edge that leaves l into the face below `base` leads to a site that this face hides. It lies
// between `base` and the lower side q of that face, but comes after `base` in its ring. Deletes
// such edges, but for `kept`. Returns whether there were any. At r, where the other halfedge of the
// base is `base`, all is mirrored.
template <bool is_left, class Sites>
bool remove_covered(PlaneGraph& graph, PlaneGraph::Edge base, const MergeStep<Sites>& step,
                    PlaneGraph::Edge kept = no_index) {
  for (bool has_removed = false;; has_removed = true) {
    const PlaneGraph::Edge e = graph.following<is_left>(base);
    const PlaneGraph::Edge q = graph.following<!is_left>(base);
    if (e == base || e == q || e == kept ||
        step.orientation(step.face(graph.target(e))) != Sign::negative) {
      return has_removed;
    }
    const MergeStep<Sites> side =
        is_left ? step.from_to(step.l(), graph.target(q)) : step.from_to(graph.target(q), step.r());
    if (side.orientation(side.face(graph.target(e))) != Sign::positive) return has_removed;
    graph.remove(e);
  }
}

// `Sites` are SquareSites or GivenSites.
template <class Sites>
class Merge {
 public:
  using Edge = PlaneGraph::Edge;
  using Step = MergeStep<Sites>;
  using ApexFace = typename Step::ApexFace;
  using Limits = typename Sites::Limits;

  Merge(Sites& sites, PlaneGraph& graph) : sites_(sites), graph_(graph) {}

  // Whether sites met that this cannot cope with; then the graph is worth nothing.
  [[nodiscard]] bool has_failed() const { return has_failed_; }
  Part fail() {
    has_failed_ = true;
    return {};
  }

  // Two parts that a great circle separates.
  Part merge(Part l, Part r, Limits limits) {
    if (has_failed_) return {};
    if (l.vertex == no_index) return r;
    if (r.vertex == no_index) return l;
    if (l.edge == no_index && r.edge == no_index) {
      return {l.vertex, graph_.add(l.vertex, r.vertex)};
    }
    find_tangent(l, r, limits);
    if (has_failed_) return {};
    const Edge base = graph_.add(l.vertex, r.vertex);
    if (l.edge != no_index) graph_.insert_after(base, graph_.previous(l.edge));
    if (r.edge != no_index) graph_.insert_after(base ^ 1, graph_.previous(r.edge));
    sew(base, limits);
    return {l.vertex, base};
  }

  // The middle one of three sites on one great circle. Weighted sites below the line of their
  // neighbors would be hidden on the boundary, which the algorithm is not made for.
  [[nodiscard]] Index middle_of(Index a, Index b, Index c) {
    for (const auto& [x, m, y] : {std::array{a, b, c}, std::array{b, c, a}, std::array{c, a, b}}) {
      const Between between =
          is_between(sites_.point(x), sites_.point(m), sites_.point(y), sites_.center());
      if (between == Between::no) continue;
      if (between == Between::below && Sites::hides_sites) has_failed_ = true;
      return m;
    }
    has_failed_ = true;
    return no_index;
  }

 private:
  // --- the outer boundary, counterclockwise, with the outer face on the right ---

  [[nodiscard]] Index boundary_next(const Part& p) const { return graph_.target(p.edge); }
  [[nodiscard]] Index boundary_previous(const Part& p) const {
    return graph_.target(graph_.previous(p.edge));
  }
  bool move_on(Part& p) const {
    p = next_on_boundary(graph_, p);
    return true;
  }
  bool move_back(Part& p) const {
    p = {boundary_previous(p), graph_.previous(p.edge) ^ 1};
    return true;
  }

  // Whether n, next to l or r on the boundary of its part, lies below the edge from l to r, or on
  // it. Moving there lowers the point where the line meets the great circle between the parts, so
  // such moves end; then all sites lie above the line.
  [[nodiscard, gnu::always_inline]] bool is_lower(const Step& step, Index n) {
    const Sign side = step.orientation(step.face(n));
    if (side != Sign::zero) return side == Sign::negative;
    return middle_of(step.l(), step.r(), n) == n;
  }

  [[gnu::always_inline]] bool move_down(const Step& step, Part& l, Part& r) {
    if (l.edge != no_index) {
      if (is_lower(step, boundary_previous(l))) return move_back(l);
      if (is_lower(step, boundary_next(l))) return move_on(l);
    }
    if (r.edge != no_index) {
      if (is_lower(step, boundary_next(r))) return move_on(r);
      if (is_lower(step, boundary_previous(r))) return move_back(r);
    }
    return false;
  }

  // Moves l and r to the ends of the lower common tangent.
  void find_tangent(Part& l, Part& r, Limits limits) {
    while (!has_failed_ && move_down(Step(sites_, limits, l.vertex, r.vertex), l, r)) {
    }
  }

  [[nodiscard, gnu::always_inline]] bool is_above(const Step& step, const ApexFace& face) {
    const Sign side = step.orientation(face);
    if (Sites::hides_sites && side == Sign::zero && face.apex != step.l() && face.apex != step.r())
      std::ignore = middle_of(step.l(), step.r(), face.apex);
    return side == Sign::positive;
  }

  // Finds the neighbor of l (or of r) above the base that makes a face with it in front of which no
  // other neighbor lies, and deletes the edges before the one to it. `edge` comes as the first one
  // beyond the base. Returns whether there is such a neighbor.
  template <bool is_left>
  [[gnu::always_inline]] bool find_candidate(const Step& step, Edge base, Edge& edge,
                                             ApexFace& face, const PlaneGraph::Links* rings,
                                             const Index* targets) {
    face = step.face(targets[edge]);
    bool has_found = is_above(step, face);
    if (Sites::hides_sites && !has_found && remove_covered<is_left>(graph_, base, step)) {
      edge = graph_.following<is_left>(base);
      face = step.face(targets[edge]);
      has_found = is_above(step, face);
    }
    if (!has_found) return false;
    for (;;) {
      const Edge next = is_left ? rings[edge].next : rings[edge].previous;
      const Index y = targets[next];
      const auto to_y = step.step_to(y);
      if (!step.is_in_conflict(face, y, to_y)) return true;
      graph_.remove(edge);
      edge = next;
      face = step.face(y, to_y);
    }
  }

  // Sews the parts together above the edge `base` from the left one to the right one. Where the
  // next step begins is known from this one: to read it from links just written would take longer
  // than all else.
  void sew(Edge base, Limits limits) {
    const PlaneGraph::Links* const rings = graph_.rings();
    const Index* const targets = graph_.targets();
    Index l = graph_.origin(base);
    Index r = graph_.target(base);
    Edge left = graph_.next(base);
    Edge right = graph_.previous(base ^ 1);
    while (!graph_.is_full()) {
      const Step step(sites_, limits, l, r);
      ApexFace left_face;
      ApexFace right_face;
      const bool has_left = find_candidate<true>(step, base, left, left_face, rings, targets);
      const bool has_right =
          find_candidate<false>(step, base ^ 1, right, right_face, rings, targets);
      if (!has_left && !has_right) return;
      if (!has_left ||
          (has_right && step.is_in_conflict(left_face, right_face.apex, right_face.side))) {
        const Edge across = rings[right ^ 1].previous;
        r = right_face.apex;
        base = graph_.add(l, r, {left, base}, {right ^ 1, across});
        right = across;
      } else {
        const Edge across = rings[left ^ 1].next;
        l = left_face.apex;
        base = graph_.add(l, r, {across, left ^ 1}, {base ^ 1, right});
        left = across;
      }
    }
    has_failed_ = true;
  }

  Sites& sites_;
  PlaneGraph& graph_;
  bool has_failed_ = false;
};

}  // namespace rondel::bulk
