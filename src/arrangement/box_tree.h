// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Boxes in space, in a tree without pointers, to find those that overlap.
//
// in    boxes, in an order in which neighbors are close to each other
// out   pairs of boxes that overlap, and the boxes that overlap a given one
// index boxes, as given; block k of level 0 has the boxes 8 k ... 8 k + 7, and block k of level i + 1
//       those around the blocks 8 k ... 8 k + 7 of level i
#pragma once

#include <algorithm>
#include <array>
#include <bit>
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
  [[nodiscard]] bool contains(const SpaceBox& other) const {
    bool is_within = true;
    for (std::size_t i = 0; i < 3; ++i) {
      is_within = is_within && low[i] <= other.low[i] && other.high[i] <= high[i];
    }
    return is_within;
  }
  [[nodiscard]] double squared_diagonal() const {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += (high[i] - low[i]) * (high[i] - low[i]);
    return sum;
  }
  void widen(double reach) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] -= reach;
      high[i] += reach;
    }
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

// Eight boxes, coordinate by coordinate, so that a box is compared with all of them at once.
class alignas(64) BoxBlock {
 public:
  static constexpr std::size_t size = 8;

  void set(std::size_t i, const SpaceBox& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low_[axis][i] = box.low[axis];
      high_[axis][i] = box.high[axis];
    }
  }
  [[nodiscard]] SpaceBox box(std::size_t i) const {
    return {{low_[0][i], low_[1][i], low_[2][i]}, {high_[0][i], high_[1][i], high_[2][i]}};
  }
  // Returns a box around all of them.
  [[nodiscard]] SpaceBox hull() const {
    SpaceBox all = box(0);
    for (std::size_t i = 1; i < size; ++i) all.include(box(i));
    return all;
  }
  // Returns a number whose bit i tells whether box i overlaps the given one. The largest distance
  // along an axis from the end of one box to the beginning of the other one tells it; its sign is
  // exact. The compiler makes vector code of this loop.
  [[nodiscard]] unsigned overlapping(const SpaceBox& box) const {
    static constexpr std::array<double, size> places = {1, 2, 4, 8, 16, 32, 64, 128};
    std::array<double, size> bits;
    for (std::size_t i = 0; i < size; ++i) {
      double apart = low_[0][i] - box.high[0];
      const auto include = [&](double x) { apart = apart < x ? x : apart; };
      include(box.low[0] - high_[0][i]);
      include(low_[1][i] - box.high[1]);
      include(box.low[1] - high_[1][i]);
      include(low_[2][i] - box.high[2]);
      include(box.low[2] - high_[2][i]);
      const double place = places[i];
      bits[i] = apart <= 0 ? place : 0.0;
    }
    const double sum =
        ((bits[0] + bits[1]) + (bits[2] + bits[3])) + ((bits[4] + bits[5]) + (bits[6] + bits[7]));
    return static_cast<unsigned>(static_cast<int>(sum));
  }

 private:
  std::array<std::array<double, size>, 3> low_;
  std::array<std::array<double, size>, 3> high_;
};

class BoxTree {
 public:
  static constexpr std::size_t fan_out = BoxBlock::size;

  BoxTree(const std::vector<SpaceBox>& boxes, unsigned threads)
      : BoxTree(
            boxes.size(), [&](std::size_t i) { return boxes[i]; }, threads) {}
  // There are `count` boxes, of which box(i) returns each.
  template <class Box>
  BoxTree(std::size_t count, const Box& box, unsigned threads) {
    add_level(count, threads, box);
    while (levels_.back().size() > 1) {
      const std::vector<BoxBlock>& below = levels_.back();
      add_level(below.size(), threads, [&](std::size_t k) { return below[k].hull(); });
    }
  }

  // Returns the number of blocks of boxes that visit_pairs() takes.
  [[nodiscard]] std::size_t num_blocks() const { return levels_[0].size(); }
  [[nodiscard]] SpaceBox box(Index i) const { return levels_[0][i / fan_out].box(i % fan_out); }
  // Returns a box near to a place, which need not be the nearest one. There must be a box.
  [[nodiscard]] Index near(const std::array<double, 3>& place) const {
    std::size_t node = 0;
    for (std::size_t level = levels_.size(); level-- > 0;) {
      const BoxBlock& block = levels_[level][node];
      std::size_t nearest = 0;
      double least = block.box(0).squared_distance(place);
      for (std::size_t i = 1; i < fan_out; ++i) {
        const double distance = block.box(i).squared_distance(place);
        if (distance >= least) continue;
        least = distance;
        nearest = i;
      }
      node = node * fan_out + nearest;
    }
    return static_cast<Index>(node);
  }

  // Calls visit(i, j) for each pair i < j of boxes that overlap, of which i is in the block; pairs
  // with the same i and a block of j follow each other.
  template <class Visit>
  void visit_pairs(std::size_t block, const Visit& visit) const {
    const BoxBlock& boxes = levels_[0][block];
    visit_blocks(block, hull(block), [&](std::size_t other) {
      const BoxBlock& others = levels_[0][other];
      for (unsigned left = boxes.overlapping(hull(other)); left != 0; left &= left - 1) {
        const auto i = static_cast<unsigned>(std::countr_zero(left));
        // A box is compared with those behind it of its own block.
        const unsigned behind = other == block ? ~0U << (i + 1) : ~0U;
        visit_each(other, others.overlapping(boxes.box(i)) & behind,
                   [&](Index j) { visit(static_cast<Index>(block * fan_out + i), j); });
      }
    });
  }

  // Calls visit(i) for each box that overlaps the given one.
  template <class Visit>
  void visit(const SpaceBox& box, const Visit& visit) const {
    visit_blocks(0, box, [&](std::size_t block) {
      visit_each(block, levels_[0][block].overlapping(box), visit);
    });
  }

 private:
  // Adds a level, of which box(i) is box i. Where a block has fewer boxes, empty ones fill it.
  template <class Box>
  void add_level(std::size_t count, unsigned threads, const Box& box) {
    std::vector<BoxBlock> blocks((count + fan_out - 1) / fan_out);
    constexpr std::size_t grain = 1024;
    system::parallel_for(threads, blocks.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin * fan_out; i < end * fan_out; ++i) {
        blocks[i / fan_out].set(i % fan_out, i < count ? box(i) : empty_box);
      }
    });
    levels_.push_back(std::move(blocks));
  }

  // Calls visit(i) for each box of a block of level 0 that has a bit.
  template <class Visit>
  static void visit_each(std::size_t block, unsigned bits, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1) {
      visit(static_cast<Index>(block * fan_out + static_cast<unsigned>(std::countr_zero(bits))));
    }
  }

  // Returns a box around those of a block of level 0.
  [[nodiscard]] SpaceBox hull(std::size_t block) const {
    if (levels_.size() == 1) return levels_[0][block].hull();
    return levels_[1][block / fan_out].box(block % fan_out);
  }

  // Calls visit(k) for each block k >= first of level 0 that overlaps a box.
  template <class Visit>
  void visit_blocks(std::size_t first, const SpaceBox& box, const Visit& visit) const {
    if (levels_[0].size() > 1) {
      descend(levels_.size() - 1, 0, first, box, visit);
    } else if (!levels_[0].empty()) {
      visit(std::size_t{0});
    }
  }
  template <class Visit>
  void descend(std::size_t level, std::size_t block, std::size_t first, const SpaceBox& box,
               const Visit& visit) const {
    // Each box of the block has so many blocks of level 0.
    const std::size_t width = std::size_t{1} << (3 * (level - 1));
    for (unsigned left = levels_[level][block].overlapping(box); left != 0; left &= left - 1) {
      const std::size_t k = block * fan_out + static_cast<unsigned>(std::countr_zero(left));
      if ((k + 1) * width <= first) continue;
      if (level == 1) {
        visit(k);
      } else {
        descend(level - 1, k, first, box, visit);
      }
    }
  }

  std::vector<std::vector<BoxBlock>> levels_;
};

}  // namespace rondel::arrangement
