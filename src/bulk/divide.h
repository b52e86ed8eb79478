// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The triangulation of the sites of one square by divide and conquer (Guibas and Stolfi, ACM Trans.
// Graph. 4, 1985), seen from the center: the faces of the hull of the sites and the center that are
// not incident to the center. Radial projection turns it into a planar regular triangulation, as a
// square lies strictly within a hemisphere.
//
// The curve splits a square by a great circle into two parts, each an interval of the spatial
// order, and merge.h makes one of two.
//
// in    the sites of a square, with positions that say on which side of a split they lie
// out   one part of a graph, or that this does not work
// index local sites and halfedges of the graph
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "bulk/few_sites.h"
#include "bulk/leaf_plan.h"
#include "bulk/merge.h"
#include "bulk/square_sites.h"
#include "order/hilbert.h"
#include "predicates/ray_order.h"
#include "system/wide_vectors.h"

namespace rondel::bulk {

// A site that rounding puts on the wrong side of the line that splits its square at this bit.
struct Misplaced {
  Index site;
  int bit;
};

template <models::SphereModel T>
class Divide {
 public:
  using Edge = PlaneGraph::Edge;

  // Apart from the misplaced ones the positions of the sites tell, exactly, on which side of a
  // split they lie.
  Divide(SquareSites<T>& sites, std::span<const Misplaced> misplaced, LeafPlan& plan,
         PlaneGraph& graph)
      : sites_(sites),
        positions_(sites.positions()),
        down_{1, -1, -sites.hand(), sites.hand()},
        misplaced_(misplaced),
        plan_(plan),
        graph_(graph),
        sewing_(sites, graph) {
    for (const Misplaced& m : misplaced) misplaced_bits_ |= std::uint64_t{1} << m.bit;
  }

  // The part of the sites begin ... end-1, or of none if has_failed(). Precondition: they are in a
  // square in which the curve is in `state` and the positions agree down to, but without, this bit.
  Part run(Index begin, Index end, unsigned state, int bit) {
    return solve(begin, end, state, bit);
  }

  // Whether the sites are too close to be separated.
  [[nodiscard]] bool has_failed() const { return sewing_.has_failed(); }

 private:
  // Leaves of one size that a group has.
  struct Waiting {
    std::array<std::size_t, num_leaf_lanes> leaves;
    std::size_t num = 0;
  };

  // The first of the sites begin ... end-1 whose bit is `last`; those before have the other value.
  // Few are counted, as nothing would predict a search.
  [[nodiscard]] Index split(Index begin, Index end, unsigned axis, int bit, unsigned last) const {
    constexpr Index few = 16;
    const auto coordinate = axis == 0 ? &SquarePosition::u : &SquarePosition::v;
    const auto is_last = [positions = positions_, coordinate, bit, last](Index i) {
      return ((positions[i].*coordinate >> bit) & 1U) == last;
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

  // The sites of the square in which the curve is in `state` and all positions agree above this
  // bit.
  Part solve(Index begin, Index end, unsigned state, int bit) {
    Part part;
    if (solve_few(begin, end, bit, part)) return part;
    const Index size = end - begin;
    if (size > max_leaf_sites && size <= LeafPlan::max_sites && are_leaves_worthwhile()) {
      return solve_by_plan(begin, end, state, bit);
    }
    return divide(begin, end, state, bit);
  }

  Part divide(Index begin, Index end, unsigned state, int bit) {
    if (bit < min_bit || is_misplaced(begin, end, bit)) return sewing_.fail();
    const Index middle = split(begin, end, state & 1U, bit, 1 - turn_of(state));
    const Part before = solve_half(begin, middle, state, bit, 0);
    const Part after = solve_half(middle, end, state, bit, 1);
    return merge(before, after, bit, state & 1U, 1 - turn_of(state));
  }

  // The first or the second half of such a square. The curve takes the quadrants (u, v) = 00, 01,
  // 11, 10, with u and v exchanged when bit 0 of the state is set, and turned around when bit 1 is.
  Part solve_half(Index begin, Index end, unsigned state, int bit, unsigned half) {
    Part part;
    if (solve_few(begin, end, bit, part)) return part;
    const Index middle = split(begin, end, 1 - (state & 1U), bit, 1 - (turn_of(state) ^ half));
    const auto child = [&](Index b, Index e, unsigned rank) {
      return solve(b, e, state ^ order::hilbert_table::state_change[rank], bit - 1);
    };
    const Part before = child(begin, middle, 2 * half);
    const Part after = child(middle, end, 2 * half + 1);
    return merge(before, after, bit, 1 - (state & 1U), 1 - (turn_of(state) ^ half));
  }

  // --- the same, planned before ---

  Part solve_by_plan(Index begin, Index end, unsigned state, int bit) {
    plan_.clear();
    plan(begin, end, state, bit);
    for (std::size_t size = 3; size <= max_leaf_sites; ++size) solve_waiting(size);
    if (has_failed()) return {};
    return plan_.run([this](const Part& before, const Part& after, const PlannedMerge& planned) {
      return merge(before, after, planned.bit, planned.axis, planned.last);
    });
  }

  // Plans for the sites of such a square. Returns whether there are any.
  bool plan(Index begin, Index end, unsigned state, int bit) {
    if (plan_leaf({begin, end, static_cast<std::uint8_t>(state), static_cast<std::int8_t>(bit),
                   whole_square})) {
      return begin != end;
    }
    if (bit < min_bit || is_misplaced(begin, end, bit)) {
      sewing_.fail();
      return false;
    }
    const unsigned axis = state & 1U;
    const unsigned last = 1 - turn_of(state);
    const Index middle = split(begin, end, axis, bit, last);
    const bool has_first = plan_half(begin, middle, state, bit, 0);
    const bool has_second = plan_half(middle, end, state, bit, 1);
    plan_merge(has_first && has_second, bit, axis, last);
    return has_first || has_second;
  }

  bool plan_half(Index begin, Index end, unsigned state, int bit, unsigned half) {
    if (plan_leaf({begin, end, static_cast<std::uint8_t>(state), static_cast<std::int8_t>(bit),
                   static_cast<std::int8_t>(half)})) {
      return begin != end;
    }
    const unsigned axis = 1 - (state & 1U);
    const unsigned last = 1 - (turn_of(state) ^ half);
    const Index middle = split(begin, end, axis, bit, last);
    const auto plan_child = [&](Index b, Index e, unsigned rank) {
      return plan(b, e, state ^ order::hilbert_table::state_change[rank], bit - 1);
    };
    const bool has_first = plan_child(begin, middle, 2 * half);
    const bool has_second = plan_child(middle, end, 2 * half + 1);
    plan_merge(has_first && has_second, bit, axis, last);
    return has_first || has_second;
  }

  void plan_merge(bool is_needed, int bit, unsigned axis, unsigned last) {
    if (!is_needed) return;
    plan_.add_merge({static_cast<std::int8_t>(bit), static_cast<std::uint8_t>(axis),
                     static_cast<std::uint8_t>(last)});
  }

  // Returns whether there is nothing to divide, or an error.
  bool plan_leaf(const Cell& cell) {
    const Index size = cell.end - cell.begin;
    if (size > max_leaf_sites) return has_failed();
    if (size == 0) return true;
    const std::size_t leaf = plan_.add_leaf(cell);
    if (size < 3) {
      plan_.set_part(leaf, size == 1 ? Part{cell.begin} : solve_two(cell.begin));
      return true;
    }
    Waiting& waiting = waiting_[size];
    LeafGroup& group = groups_[size];
    group.num_sites = size;
    group.set(waiting.num, sites_.points() + cell.begin, limits_of(cell.bit + 1));
    waiting.leaves[waiting.num] = leaf;
    if (++waiting.num == num_leaf_lanes) solve_waiting(size);
    return true;
  }

  void solve_waiting(std::size_t size) {
    Waiting& waiting = waiting_[size];
    if (waiting.num == 0) return;
    LeafGroup& group = groups_[size];
    for (std::size_t lane = waiting.num; lane < num_leaf_lanes; ++lane) group.repeat(lane);
    find_leaf_faces(group);
    for (std::size_t lane = 0; lane < waiting.num; ++lane) {
      const std::size_t leaf = waiting.leaves[lane];
      const Cell& cell = plan_.leaf_at(leaf);
      if (group.certain[lane] != 0) {
        ++num_certain_;
        sites_.count_filtered(num_volumes(size));
        plan_.set_part(leaf, draw_leaf(graph_, group, lane, cell.begin));
      } else {
        ++num_unsure_;
        plan_.set_part(leaf, solve_unsure(cell));
      }
    }
    waiting.num = 0;
  }

  Part solve_unsure(const Cell& cell) {
    if (cell.half != whole_square) {
      return solve_half(cell.begin, cell.end, cell.state, cell.bit,
                        static_cast<unsigned>(cell.half));
    }
    Part part;
    if (solve_few(cell.begin, cell.end, cell.bit, part)) return part;
    return divide(cell.begin, cell.end, cell.state, cell.bit);
  }

  // Leaves cost more than they save in vectors of two numbers, and where sites are in regular places.
  [[nodiscard]] bool are_leaves_worthwhile() const {
    constexpr std::size_t enough = 32;
    return system::has_wide_vectors() && num_unsure_ < enough + num_certain_;
  }

  // --- parts ---

  // Two parts of which the second one has the bit `last` along this axis.
  Part merge(const Part& before, const Part& after, int bit, unsigned axis, unsigned last) {
    const double down = down_[2 * axis + last];
    return sewing_.merge(lower_end(before, axis, down), lower_end(after, axis, down),
                         limits_of(bit + 1));
  }

  // The part by that end of its edge which lies further down along the other axis, where the
  // tangent is closer. Without branches, as nothing would predict them.
  [[nodiscard]] Part lower_end(const Part& part, unsigned axis, double down) const {
    constexpr std::array across = {&SquarePoint::v, &SquarePoint::u};
    if (part.edge == no_index) return part;
    const Part other = next_on_boundary(graph_, part);
    const auto depth = [&](Index i) { return down * (sites_.points()[i].*across[axis]); };
    const auto is_other = -static_cast<Index>(depth(part.vertex) < depth(other.vertex));
    const auto choose = [is_other](Index x, Index y) { return x ^ ((x ^ y) & is_other); };
    return {choose(part.vertex, other.vertex), choose(part.edge, other.edge)};
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
        return has_failed();
    }
  }

  [[nodiscard]] bool is_misplaced(Index begin, Index end, int bit) const {
    return (misplaced_bits_ >> bit & 1U) != 0 &&
           std::ranges::any_of(misplaced_, [&](const Misplaced& m) {
             return m.bit == bit && begin <= m.site && m.site < end;
           });
  }

  // For a square of 2^bits positions either way.
  [[nodiscard]] const SquareLimits& limits_of(int bits) const { return sites_.limits_of(bits); }

  // Joins two sites. If two weighted sites are on one ray, the lower one is hidden, which no square
  // tells from the other; then this fails.
  Part solve_two(Index a) {
    if (T::hides_sites && is_close(a, a + 1) &&
        predicates::are_on_one_ray(sites_.point(a), sites_.point(a + 1), sites_.center())) {
      return sewing_.fail();
    }
    return {a, graph_.add(a, a + 1)};
  }

  // Whether two positions are those of one ray, but for roundings.
  [[nodiscard]] bool is_close(Index a, Index b) const {
    constexpr std::uint64_t roundings = 16;
    const SquarePosition& p = positions_[a];
    const SquarePosition& q = positions_[b];
    return p.u - q.u + roundings < 2 * roundings && p.v - q.v + roundings < 2 * roundings;
  }

  Part solve_three(Index a, const SquareLimits& limits) {
    const MergeStep<SquareSites<T>> step(sites_, limits, a, a + 1);
    const Sign turn = step.orientation(step.face(a + 2));
    if (turn == Sign::zero) return solve_chain(a);
    const auto is_turned = static_cast<Index>(turn == Sign::negative);
    return {a, draw_triangle(graph_, {a, a + 1 + is_turned, a + 2 - is_turned})};
  }

  // Returns whether no three are on one great circle.
  bool solve_four(Index a, const SquareLimits& limits, Part& part) {
    const MergeStep<SquareSites<T>> ab(sites_, limits, a, a + 1);
    const MergeStep<SquareSites<T>> ac(sites_, limits, a, a + 2);
    const MergeStep<SquareSites<T>> bc(sites_, limits, a + 1, a + 2);
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
    const FourSites& four = few_sites::orders[signs];
    std::array<Index, 4> p{};
    for (std::size_t i = 0; i < 4; ++i) p[i] = a + four.order[i];
    const auto is_last_in_conflict = [&] {
      const MergeStep<SquareSites<T>> step(sites_, limits, p[0], p[1]);
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
    const Index middle = sewing_.middle_of(a, a + 1, a + 2);
    if (has_failed()) return {};
    const Edge e = graph_.add(middle, middle == a ? a + 1 : a);
    graph_.insert_after(graph_.add(middle, middle == a + 2 ? a + 1 : a + 2), e);
    return {middle, e};
  }

  SquareSites<T>& sites_;
  const SquarePosition* positions_;
  // On which side of the way from one part to the next is down: by axis, then by direction.
  std::array<double, 4> down_;
  std::span<const Misplaced> misplaced_;
  std::uint64_t misplaced_bits_ = 0;
  LeafPlan& plan_;
  std::array<LeafGroup, max_leaf_sites + 1> groups_;  // by number of sites
  std::array<Waiting, max_leaf_sites + 1> waiting_{};
  std::size_t num_certain_ = 0;  // leaves
  std::size_t num_unsure_ = 0;
  PlaneGraph& graph_;
  Merge<SquareSites<T>> sewing_;
};

}  // namespace rondel::bulk
