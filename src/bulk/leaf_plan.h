// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What divide and conquer will do with the sites of a small square: leaves, and merges of what stands
// before them, in the order of the recursion. So the leaves are known before the first merge, and those
// with equally many sites are triangulated together (leaves.h).
//
//      leaf 0   leaf 1   merge   leaf 2   merge ...
//
// in    the leaves and merges, one by one
// out   the same
// index local sites
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "bulk/leaves.h"

namespace rondel::bulk {

// The sites begin ... end-1 of a square in which the curve is in `state` and the positions agree above
// this bit; or those of its first or second half.
struct Cell {
  Index begin;
  Index end;
  std::uint8_t state;
  std::int8_t bit;
  std::int8_t half;  // or whole_square
};

inline constexpr std::int8_t whole_square = -1;

// A merge of parts of which the second one has the bit `last` along this axis.
struct PlannedMerge {
  std::int8_t bit;
  std::uint8_t axis;
  std::uint8_t last;
};

class LeafPlan {
 public:
  // Squares of at most so many sites are planned; leaves are not empty.
  static constexpr Index max_sites = 512;

  void clear() { num_leaves_ = num_steps_ = 0; }

  // Returns the number of the leaf.
  std::size_t add_leaf(const Cell& cell) {
    steps_[num_steps_++] = {.bit = leaf, .axis = 0, .last = 0};
    leaves_[num_leaves_] = cell;
    return num_leaves_++;
  }
  void add_merge(const PlannedMerge& merge) { steps_[num_steps_++] = merge; }

  [[nodiscard]] const Cell& leaf_at(std::size_t i) const { return leaves_[i]; }
  void set_part(std::size_t leaf_number, const Part& part) { parts_[leaf_number] = part; }

  // Calls merge(before, after, planned) for one merge after the other. Returns what is left, no part if
  // there are no leaves.
  template <class Merge>
  Part run(Merge merge) {
    std::size_t next = 0;  // leaf
    std::size_t top = 0;   // parts below are not merged yet; they are never behind the next leaf
    for (const PlannedMerge& step : std::span(steps_).first(num_steps_)) {
      if (step.bit == leaf) {
        parts_[top++] = parts_[next++];
      } else {
        --top;
        parts_[top - 1] = merge(parts_[top - 1], parts_[top], step);
      }
    }
    return top == 0 ? Part() : parts_[0];
  }

 private:
  static constexpr std::int8_t leaf = -1;

  std::array<Cell, max_sites> leaves_;
  std::array<Part, max_sites> parts_;  // by leaf
  std::array<PlannedMerge, std::size_t{2} * max_sites> steps_;
  std::size_t num_leaves_;
  std::size_t num_steps_;
};

}  // namespace rondel::bulk
