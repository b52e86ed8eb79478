// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The triangulation of the sites of one cell by divide and conquer (Guibas and Stolfi, ACM Trans.
// Graph. 4, 1985), seen from the center: the faces of the hull of the sites and the center that are
// not incident to the center. Radial projection turns it into a planar regular triangulation, as a
// cell lies strictly within a hemisphere.
//
//      .----.   .----.     The curve splits a cell by a great circle into two parts, each an
//      | L   l--r  R |     interval of the spatial order. A merge finds the lower common tangent
//      |    / \/ \   |     of their outer boundaries and climbs: each step tries the first
//      |   x--r'--\  |     neighbors of l and r above the edge (l, r), deletes those in front of
//      '----'   '----'     which another one lies, and adds the edge of the lower face.
//
// docs/theory/blocks.md shows that this holds for weighted sites as well: the cells of the power
// diagrams of L and R meet in one chain, and what lies behind it is never met again.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

#include "blocks/hilbert.h"
#include "bulk/collinear.h"
#include "bulk/few_sites.h"
#include "bulk/merge_step.h"
#include "bulk/plane_graph.h"
#include "predicates/ray_order.h"

namespace rondel::bulk {

// A site that rounding puts on the wrong side of the line that splits its cell at this bit.
struct Misplaced {
  Index site;
  int bit;
};

template <incremental::SphereTraits T>
class Divide {
 public:
  using Edge = PlaneGraph::Edge;

  // Cells are split down to this bit.
  static constexpr int least_bit = 14;

  // Apart from the misplaced ones the positions of the sites tell, exactly, on which side of a
  // split they lie.
  Divide(const CellSites<T>& sites, std::span<const Misplaced> misplaced, PlaneGraph& graph)
      : sites_(sites), positions_(sites.positions()), misplaced_(misplaced), graph_(graph) {
    for (const Misplaced& m : misplaced) misplaced_bits_ |= std::uint64_t{1} << m.bit;
    for (int bit = 0; bit <= blocks::position_bits; ++bit) {
      limits_[static_cast<std::size_t>(bit)] =
          sites.limits(std::ldexp(1, bit + 1 - blocks::position_bits));
    }
  }

  // Returns an edge of the outer boundary, with the outer face on its right, or no_index if
  // the sites are too close to be separated. Precondition: two sites or more, in the cell in which
  // the curve is in `state` and the positions agree down to, but without, this bit.
  Edge run(unsigned state, int bit) {
    graph_.clear(positions_.size());
    const Part all = solve(0, static_cast<Index>(positions_.size()), state, bit);
    return has_failed_ ? no_index : all.edge;
  }

 private:
  // A vertex of the outer boundary and the edge that leaves it there; no edge for a single vertex.
  struct Part {
    Index vertex = no_index;
    Edge edge = no_index;
  };

  // The first of the sites begin ... end-1 whose bit is `last`; those before have the other value.
  // Few are counted, as nothing would predict a search.
  [[nodiscard]] Index split(Index begin, Index end, unsigned axis, int bit, unsigned last) const {
    constexpr Index few = 16;
    const std::uint64_t* const positions = &positions_.data()->u + axis;  // every other number
    const auto is_last = [positions, bit, last](Index i) {
      return ((positions[2 * std::size_t{i}] >> bit) & 1U) == last;
    };
    while (end - begin > few) {
      const Index middle = begin + (end - begin) / 2;
      if (is_last(middle)) {
        end = middle;
      } else {
        begin = middle + 1;
      }
    }
    Index count = 0;
    for (Index i = begin; i < end; ++i) count += static_cast<Index>(is_last(i));
    return end - count;
  }

  // The sites of the cell in which the curve is in `state` and all positions agree above this bit.
  Part solve(Index begin, Index end, unsigned state, int bit) {
    Part part;
    if (solve_few(begin, end, bit, part)) return part;
    if (bit < least_bit || is_misplaced(begin, end, bit)) return fail();
    const Index middle = split(begin, end, state & 1U, bit, 1 - turn_of(state));
    const Part before = solve_half(begin, middle, state, bit, 0);
    const Part after = solve_half(middle, end, state, bit, 1);
    return merge(before, after, limits_of(bit + 1));
  }

  // The first or the second half of such a cell. The curve takes the quadrants (u, v) = 00, 01, 11,
  // 10, with u and v exchanged when bit 0 of the state is set, and turned around when bit 1 is.
  Part solve_half(Index begin, Index end, unsigned state, int bit, unsigned half) {
    Part part;
    if (solve_few(begin, end, bit, part)) return part;
    const Index middle = split(begin, end, 1 - (state & 1U), bit, 1 - (turn_of(state) ^ half));
    const auto child = [&](Index b, Index e, unsigned rank) {
      return solve(b, e, state ^ blocks::hilbert_table::state_change[rank], bit - 1);
    };
    const Part before = child(begin, middle, 2 * half);
    const Part after = child(middle, end, 2 * half + 1);
    return merge(before, after, limits_of(bit + 1));
  }

  [[nodiscard]] static unsigned turn_of(unsigned state) { return state >> 1 & 1U; }

  // Whether there is nothing to divide, or an error.
  bool solve_few(Index begin, Index end, int bit, Part& part) {
    switch (end - begin) {
      case 0:
        return true;
      case 1:
        part = {begin};
        return true;
      case 2:
        part = solve_two(begin);
        return true;
      case 3:
        part = solve_three(begin, limits_of(bit + 1));
        return true;
      case 4:
        return solve_four(begin, limits_of(bit + 1), part);
      default:
        return has_failed_;
    }
  }

  [[nodiscard]] bool is_misplaced(Index begin, Index end, int bit) const {
    return (misplaced_bits_ >> bit & 1U) != 0 &&
           std::ranges::any_of(misplaced_, [&](const Misplaced& m) {
             return m.bit == bit && begin <= m.site && m.site < end;
           });
  }

  // For a cell of 2^bits positions either way.
  [[nodiscard]] const CellLimits& limits_of(int bits) const {
    return limits_[static_cast<std::size_t>(bits)];
  }

  Part fail() {
    has_failed_ = true;
    return {};
  }

  // Of two weighted sites on one ray the lower one is hidden, which no cell tells from the other.
  Part solve_two(Index a) {
    if (T::hides_sites && is_close(a, a + 1) &&
        predicates::are_on_one_ray(sites_.site(a), sites_.site(a + 1), sites_.center())) {
      return fail();
    }
    return {a, graph_.add(a, a + 1)};
  }

  // Whether two positions are those of one ray, but for roundings.
  [[nodiscard]] bool is_close(Index a, Index b) const {
    constexpr std::uint64_t roundings = 16;
    const CellPosition& p = positions_[a];
    const CellPosition& q = positions_[b];
    return p.u - q.u + roundings < 2 * roundings && p.v - q.v + roundings < 2 * roundings;
  }

  Part solve_three(Index a, const CellLimits& limits) {
    const MergeStep<T> step(sites_, limits, a, a + 1);
    const Sign turn = step.orientation(step.face(a + 2));
    if (turn == Sign::zero) return solve_chain(a);
    const auto is_turned = static_cast<Index>(turn == Sign::negative);
    return {a, draw_triangle(graph_, {a, a + 1 + is_turned, a + 2 - is_turned})};
  }

  // Returns whether no three are on one great circle.
  bool solve_four(Index a, const CellLimits& limits, Part& part) {
    const MergeStep<T> ab(sites_, limits, a, a + 1);
    const MergeStep<T> ac(sites_, limits, a, a + 2);
    const MergeStep<T> bc(sites_, limits, a + 1, a + 2);
    const std::array turns = {ab.orientation(ab.face(a + 2)), ab.orientation(ab.face(a + 3)),
                              ac.orientation(ac.face(a + 3)), bc.orientation(bc.face(a + 3))};
    unsigned signs = 0;
    bool is_zero = false;
    for (unsigned i = 0; i < 4; ++i) {
      signs |= static_cast<unsigned>(turns[i] == Sign::positive) << i;
      is_zero |= turns[i] == Sign::zero;
    }
    if (is_zero) [[unlikely]]
      return false;
    const FourPoints& four = few_sites::orders[signs];
    std::array<Index, 4> p{};
    for (std::size_t i = 0; i < 4; ++i) p[i] = a + four.order[i];
    const auto is_last_in_conflict = [&] {
      const MergeStep<T> step(sites_, limits, p[0], p[1]);
      return step.is_in_conflict(step.face(p[2]), p[3]);
    };
    if (!four.has_inner_point) {
      const auto turn = static_cast<std::size_t>(is_last_in_conflict());
      part.edge =
          draw_quadrilateral(graph_, {p[turn], p[1 + turn], p[2 + turn], p[3 * (1 - turn)]});
    } else if (!T::hides_sites || is_last_in_conflict()) {
      part.edge = draw_triangle_around(graph_, p);
    } else {
      part.edge = draw_triangle(graph_, {p[0], p[1], p[2]});
    }
    part.vertex = graph_.origin(part.edge);
    return true;
  }

  // Three sites on one great circle.
  Part solve_chain(Index a) {
    const Index middle = middle_of(a, a + 1, a + 2);
    if (has_failed_) return {};
    const Edge e = graph_.add(middle, middle == a ? a + 1 : a);
    graph_.insert_after(graph_.add(middle, middle == a + 2 ? a + 1 : a + 2), e);
    return {middle, e};
  }

  // --- the outer boundary, counterclockwise, with the outer face on the right ---

  [[nodiscard]] Index boundary_next(const Part& p) const { return graph_.target(p.edge); }
  [[nodiscard]] Index boundary_previous(const Part& p) const {
    return graph_.target(graph_.previous(p.edge));
  }
  bool move_on(Part& p) const {
    p = {graph_.target(p.edge), graph_.next(p.edge ^ 1)};
    return true;
  }
  bool move_back(Part& p) const {
    p = {boundary_previous(p), graph_.previous(p.edge) ^ 1};
    return true;
  }

  // Whether n, next to l or r on the boundary of its part, lies below the edge from l to r, or on
  // it. Moving there lowers the point where the line meets the great circle between the parts, so
  // such moves end; then all sites lie above the line.
  [[nodiscard]] bool is_lower(const MergeStep<T>& step, Index n) {
    const Sign side = step.orientation(step.face(n));
    if (side != Sign::zero) return side == Sign::negative;
    return middle_of(step.l(), step.r(), n) == n;
  }

  bool move_down(const MergeStep<T>& step, Part& l, Part& r) {
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
  void find_tangent(Part& l, Part& r, const CellLimits& limits) {
    while (!has_failed_ && move_down(MergeStep<T>(sites_, limits, l.vertex, r.vertex), l, r)) {
    }
  }

  // The middle one of three sites on one great circle. Weighted sites below the line of their
  // neighbors would be hidden on the boundary, which the algorithm is not made for.
  [[nodiscard]] Index middle_of(Index a, Index b, Index c) {
    for (const auto& [x, m, y] : {std::array{a, b, c}, std::array{b, c, a}, std::array{c, a, b}}) {
      const Between between =
          is_between(sites_.site(x), sites_.site(m), sites_.site(y), sites_.center());
      if (between == Between::no) continue;
      if (between == Between::below && T::hides_sites) has_failed_ = true;
      return m;
    }
    has_failed_ = true;
    return no_index;
  }

  // Two parts that a great circle separates.
  Part merge(Part l, Part r, const CellLimits& limits) {
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
    climb(base, limits);
    return {l.vertex, base};
  }

  using Face = typename MergeStep<T>::Face;

  [[nodiscard]] bool is_above(const MergeStep<T>& step, const Face& face) {
    const Sign side = step.orientation(face);
    if (T::hides_sites && side == Sign::zero)
      std::ignore = middle_of(step.l(), step.r(), face.apex);
    return side == Sign::positive;
  }

  // An edge that leaves l or r into the face below `base` leads to a site that this face hides. It
  // lies between `base` and the lower side q of that face, but comes after `base` in its ring.
  void remove_covered(Edge base, const MergeStep<T>& step, const CellLimits& limits) {
    for (;;) {
      const Edge e = graph_.next(base);
      const Edge q = graph_.previous(base);
      if (e == base || e == q || step.orientation(step.face(graph_.target(e))) != Sign::negative)
        break;
      const MergeStep<T> side(sites_, limits, step.l(), graph_.target(q));
      if (side.orientation(side.face(graph_.target(e))) != Sign::positive) break;
      graph_.remove(e);
    }
    for (;;) {
      const Edge e = graph_.previous(base ^ 1);
      const Edge q = graph_.next(base ^ 1);
      if (e == (base ^ 1) || e == q ||
          step.orientation(step.face(graph_.target(e))) != Sign::negative)
        break;
      const MergeStep<T> side(sites_, limits, graph_.target(q), step.r());
      if (side.orientation(side.face(graph_.target(e))) != Sign::positive) break;
      graph_.remove(e);
    }
  }

  // Sews the parts together above the edge `base` from the left one to the right one.
  void climb(Edge base, const CellLimits& limits) {
    const PlaneGraph::Ring* const rings = graph_.rings();
    const PlaneGraph::End* const ends = graph_.ends();
    Index l = graph_.origin(base);
    Index r = graph_.target(base);
    while (!graph_.is_full()) {
      const MergeStep<T> step(sites_, limits, l, r);
      if constexpr (T::hides_sites) remove_covered(base, step, limits);
      Edge left = rings[base].next;
      Face left_face = step.face(ends[left].target);
      const bool has_left = left != base && is_above(step, left_face);
      if (has_left) {
        for (;;) {
          const Edge next = rings[left].next;
          const Index y = ends[next].target;
          if (y == r || !step.is_in_conflict(left_face, y)) break;
          graph_.remove(left);
          left = next;
          left_face = step.face(y);
        }
      }
      Edge right = rings[base ^ 1].previous;
      Face right_face = step.face(ends[right].target);
      const bool has_right = right != (base ^ 1) && is_above(step, right_face);
      if (has_right) {
        for (;;) {
          const Edge next = rings[right].previous;
          const Index y = ends[next].target;
          if (y == l || !step.is_in_conflict(right_face, y)) break;
          graph_.remove(right);
          right = next;
          right_face = step.face(y);
        }
      }
      if (!has_left && !has_right) return;
      if (!has_left || (has_right && step.is_in_conflict(left_face, right_face.apex))) {
        r = right_face.apex;
        base = graph_.add(l, r, base, rings[right ^ 1].previous);
      } else {
        l = left_face.apex;
        base = graph_.add(l, r, left ^ 1, rings[base ^ 1].previous);
      }
    }
    has_failed_ = true;
  }

  const CellSites<T>& sites_;
  std::span<const CellPosition> positions_;
  std::span<const Misplaced> misplaced_;
  std::uint64_t misplaced_bits_ = 0;
  PlaneGraph& graph_;
  std::array<CellLimits, blocks::position_bits + 1> limits_;  // by bits
  bool has_failed_ = false;
};

}  // namespace rondel::bulk
