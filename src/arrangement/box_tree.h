// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Boxes in space, in a tree without pointers, to find those that overlap.
//
// in    boxes, in an order in which neighbors are close to each other
// out   pairs of boxes that overlap, and the boxes that overlap a given one
// index boxes, as given; nodes of level 0 are the boxes, node k of level i + 1 consists of the nodes
//       8 k ... 8 k + 7 of level i
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "rondel/types.h"
#include "system/parallel.h"

namespace rondel::arrangement {

struct SpaceBox {
  std::array<double, 3> low;
  std::array<double, 3> high;

  [[nodiscard]] bool overlaps(const SpaceBox& other) const {
    // Nothing depends on the first comparisons, so that no branch has to be foreseen.
    int num_overlapping = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      num_overlapping += static_cast<int>(low[i] <= other.high[i]);
      num_overlapping += static_cast<int>(other.low[i] <= high[i]);
    }
    return num_overlapping == 6;
  }
  void include(const SpaceBox& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
  // Returns the squared distance of a place from the box.
  [[nodiscard]] double squared_distance(const std::array<double, 3>& place) const {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double beyond = std::max({low[i] - place[i], place[i] - high[i], 0.0});
      sum += beyond * beyond;
    }
    return sum;
  }
};

// A box that overlaps none, and one that contains the sphere.
inline constexpr SpaceBox empty_box = {{4, 4, 4}, {-4, -4, -4}};
inline constexpr SpaceBox whole_box = {{-2, -2, -2}, {2, 2, 2}};

class BoxTree {
 public:
  static constexpr std::size_t fan_out = 8;

  BoxTree(std::vector<SpaceBox> boxes, unsigned threads) {
    levels_.push_back(std::move(boxes));
    while (levels_.back().size() > 1) {
      const std::vector<SpaceBox>& below = levels_.back();
      std::vector<SpaceBox> level((below.size() + fan_out - 1) / fan_out);
      constexpr std::size_t grain = 4096;
      system::parallel_for(threads, level.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          level[k] = below[k * fan_out];
          for (std::size_t i = 1; i < size_of(below, k); ++i) {
            level[k].include(below[k * fan_out + i]);
          }
        }
      });
      levels_.push_back(std::move(level));
    }
  }

  // Returns the number of blocks of boxes that visit_pairs() takes.
  [[nodiscard]] std::size_t num_blocks() const {
    return levels_.size() > 1 ? levels_[1].size() : 0;
  }
  [[nodiscard]] const SpaceBox& box(Index i) const { return levels_[0][i]; }
  // Returns a box near to a place, which need not be the nearest one. There must be a box.
  [[nodiscard]] Index near(const std::array<double, 3>& place) const {
    std::size_t node = 0;
    for (std::size_t level = levels_.size() - 1; level-- > 0;) {
      const std::vector<SpaceBox>& boxes = levels_[level];
      std::size_t nearest = node * fan_out;
      double least = boxes[nearest].squared_distance(place);
      for (std::size_t i = 1; i < size_of(boxes, node); ++i) {
        const double distance = boxes[node * fan_out + i].squared_distance(place);
        if (distance >= least) continue;
        least = distance;
        nearest = node * fan_out + i;
      }
      node = nearest;
    }
    return static_cast<Index>(node);
  }

  // Calls visit(i, j) for each pair i < j of boxes that overlap, of which i is in the block.
  template <class Visit>
  void visit_pairs(std::size_t block, const Visit& visit) const {
    const std::vector<SpaceBox>& boxes = levels_[0];
    const auto visit_block = [&](std::size_t other) {
      const std::size_t end = other * fan_out + size_of(boxes, other);
      for (std::size_t i = block * fan_out; i < block * fan_out + size_of(boxes, block); ++i) {
        if (!boxes[i].overlaps(levels_[1][other])) continue;
        for (std::size_t j = std::max(other * fan_out, i + 1); j < end; ++j) {
          if (boxes[i].overlaps(boxes[j])) visit(static_cast<Index>(i), static_cast<Index>(j));
        }
      }
    };
    descend(levels_.size() - 1, 0, 1, block, levels_[1][block], visit_block);
  }

  // Calls visit(i) for each box that overlaps the given one.
  template <class Visit>
  void visit(const SpaceBox& box, const Visit& visit) const {
    if (levels_[0].empty()) return;
    const auto visit_one = [&](std::size_t i) { visit(static_cast<Index>(i)); };
    descend(levels_.size() - 1, 0, 0, 0, box, visit_one);
  }

 private:
  // Returns the number of nodes below node k.
  static std::size_t size_of(const std::vector<SpaceBox>& below, std::size_t k) {
    return std::min(fan_out, below.size() - k * fan_out);
  }

  // Calls visit(k) for each node k >= first of level `last` below a node that overlaps a box.
  template <class Visit>
  void descend(std::size_t level, std::size_t node, std::size_t last, std::size_t first,
               const SpaceBox& box, const Visit& visit) const {
    if (!levels_[level][node].overlaps(box)) return;
    if (level == last) {
      if (node >= first) visit(node);
      return;
    }
    // The nodes of level `last` below this one end before `end`.
    std::size_t end = node + 1;
    for (std::size_t l = last; l < level; ++l) end *= fan_out;
    if (end <= first) return;
    const std::vector<SpaceBox>& below = levels_[level - 1];
    for (std::size_t i = 0; i < size_of(below, node); ++i) {
      descend(level - 1, node * fan_out + i, last, first, box, visit);
    }
  }

  std::vector<std::vector<SpaceBox>> levels_;
};

}  // namespace rondel::arrangement
