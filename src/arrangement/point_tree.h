// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Nodes in boxes, to find those in a part of space.
//
// in    nodes along the spatial order
// out   the first node in a box that has a property
// index nodes: as in `points`; blocks of level 0 have 8 nodes of the list, those of level i + 1
//       have 8 blocks of level i
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/box_tree.h"
#include "rondel/types.h"
#include "system/parallel.h"

namespace rondel::arrangement {

class PointTree {
 public:
  PointTree(std::span<const Point> points, std::vector<Index> nodes, unsigned threads)
      : points_(points), nodes_(std::move(nodes)) {
    if (nodes_.empty()) return;
    levels_.push_back(blocks_of(nodes_.size(), threads, [&](SpaceBox& box, std::size_t i) {
      box.include(box_of(points_[nodes_[i]]));
    }));
    while (levels_.back().size() > 1) {
      const std::vector<SpaceBox>& below = levels_.back();
      levels_.push_back(blocks_of(below.size(), threads,
                                  [&](SpaceBox& box, std::size_t i) { box.include(below[i]); }));
    }
  }

  [[nodiscard]] std::size_t size() const { return nodes_.size(); }

  // Returns the first node in the box for which is_wanted(node) is true, or no_index.
  template <class Wanted>
  [[nodiscard]] Index first_in(const SpaceBox& box, const Wanted& is_wanted) const {
    return levels_.empty() ? no_index : search(levels_.size() - 1, 0, box, is_wanted);
  }

 private:
  static constexpr std::size_t fan_out = 8;

  static SpaceBox box_of(const Point& p) { return {{p.x, p.y, p.z}, {p.x, p.y, p.z}}; }

  // Returns the boxes of blocks of `count` parts, of which include(box, i) includes part i.
  template <class Include>
  static std::vector<SpaceBox> blocks_of(std::size_t count, unsigned threads,
                                         const Include& include) {
    std::vector<SpaceBox> blocks((count + fan_out - 1) / fan_out, empty_box);
    constexpr std::size_t grain = 4096;
    system::parallel_for(threads, blocks.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        for (std::size_t i = k * fan_out; i < std::min(count, (k + 1) * fan_out); ++i) {
          include(blocks[k], i);
        }
      }
    });
    return blocks;
  }

  template <class Wanted>
  [[nodiscard]] Index search(std::size_t level, std::size_t block, const SpaceBox& box,
                             const Wanted& is_wanted) const {
    if (!levels_[level][block].overlaps(box)) return no_index;
    const std::size_t count = level == 0 ? nodes_.size() : levels_[level - 1].size();
    const std::size_t end = std::min(count, (block + 1) * fan_out);
    for (std::size_t i = block * fan_out; i < end; ++i) {
      if (level == 0) {
        if (box_of(points_[nodes_[i]]).overlaps(box) && is_wanted(nodes_[i])) return nodes_[i];
        continue;
      }
      const Index found = search(level - 1, i, box, is_wanted);
      if (found != no_index) return found;
    }
    return no_index;
  }

  std::span<const Point> points_;
  std::vector<Index> nodes_;
  std::vector<std::vector<SpaceBox>> levels_;
};

}  // namespace rondel::arrangement
