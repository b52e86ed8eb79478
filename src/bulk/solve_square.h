// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sites of one square, from positions that rounding may have moved to a triangulation.
#pragma once

#include <algorithm>
#include <bit>
#include <optional>
#include <span>
#include <vector>

#include "bulk/divide.h"
#include "bulk/input.h"
#include "bulk/squares.h"

namespace rondel::bulk {

// Positions that may be wrong, as far as divide and conquer would notice.
template <models::SphereModel T>
class PositionCheck {
 public:
  PositionCheck(const Input& input, const Block& block, SquareSites<T>& sites,
                std::vector<Misplaced>& misplaced)
      : input_(input), block_(block), sites_(sites), misplaced_(misplaced) {}

  // Returns whether all sites can be told apart by positions, but for those listed as misplaced.
  // The site of rank block.begin is site `first` of the square.
  bool run(Index first) {
    misplaced_.clear();
    return std::ranges::all_of(
        sites_.doubtful(), [&](Index i) { return check_position(block_.begin + (i - first), i); });
  }

 private:
  static bool is_close(std::uint64_t p, std::uint64_t q) {
    return p < q + position_rounding && q < p + position_rounding;
  }

  bool check_position(Index rank, Index i) {
    if (sites_.point(i) == sites_.center()) return false;
    // The one by which the site is in its place. It may be exact, or none if a difference
    // overflows.
    const order::CubePosition p = input_.position(rank);
    const order::CubePosition q = order::exact_cube_position(sites_.point(i), sites_.center());
    if (p.face != q.face || q.face != block_.square.corner.face) return false;
    if (!is_close(p.u, q.u) || !is_close(p.v, q.v)) return false;
    sites_.set_position(i, {p.u, p.v});
    const std::uint64_t difference = ((p.u ^ q.u) | (p.v ^ q.v)) >> least_bit;
    if (difference != 0) {
      misplaced_.push_back({i, least_bit + static_cast<int>(std::bit_width(difference)) - 1});
    }
    return true;
  }

  const Input& input_;
  const Block& block_;
  SquareSites<T>& sites_;
  std::vector<Misplaced>& misplaced_;
};

// Triangulates the sites of a block, which are the sites first, first + 1, ... of `sites` and of
// the graph; or returns nothing if this does not work.
template <models::SphereModel T>
std::optional<Part> solve_square(const Input& input, const Block& block, Index first,
                                 SquareSites<T>& sites, std::vector<Misplaced>& misplaced,
                                 PlaneGraph& graph) {
  if (!PositionCheck<T>(input, block, sites, misplaced).run(first)) return std::nullopt;
  Divide<T> divide(sites, misplaced, graph);
  const Part all = divide.run(first, first + (block.end - block.begin), block.square.state,
                              block.square.bits - 1);
  if (divide.has_failed()) return std::nullopt;
  return all;
}

}  // namespace rondel::bulk
