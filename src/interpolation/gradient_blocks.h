// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The fits of many vertices (local_fit.h), several at once: those with about as many neighbors share
// lanes, so that little of a lane is idle.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "bulk/builder_pool.h"
#include "interpolation/ground.h"
#include "interpolation/local_fit.h"
#include "interpolation/solid_rings.h"
#include "rondel/interpolate.h"
#include "rondel/types.h"
#include "system/parallel.h"

namespace rondel::interpolation {

// Of a range of vertices.
class GradientBlocks {
 public:
  // So many vertices are one thread's work at a time: what they need fits the fastest cache.
  static constexpr std::size_t vertices_per_piece = 256;

  GradientBlocks(const Ground& ground, SolidRings& finder, const GradientOptions& options,
                 std::size_t begin, std::size_t end);

  [[nodiscard]] std::size_t size() const { return starts_.size() - 1; }
  // No more neighbors than these has the vertex of this number in the range.
  [[nodiscard]] std::size_t most_neighbors(std::size_t i) const {
    return starts_[i + 1] - starts_[i];
  }

  // take(fits, members): the numbers of vertices in the range by lanes.
  template <class Take>
  void for_each_block(const Take& take) {
    for (std::size_t at = 0; at < size(); at += LocalFits::lanes) {
      const std::span members(&order_[at], std::min(LocalFits::lanes, size() - at));
      fit(members);
      take(fits_, members);
    }
  }
  // Of the vertex of this number, which has been in a block.
  [[nodiscard]] std::span<const Index> neighbors(std::size_t i) const {
    return {neighbors_.data() + starts_[i], num_near_[i]};
  }

 private:
  void sort_by_size();
  void fit(std::span<const Index> members);
  void add_neighbors(std::size_t lane, std::size_t i);

  const Ground& ground_;
  bool with_lines_;
  std::size_t begin_;
  std::vector<Index> neighbors_;  // of one after the other; those too far are taken out in blocks
  std::vector<std::size_t> starts_ = {0};
  std::vector<std::size_t> num_near_;
  std::vector<Index> order_;
  LocalFits fits_;
};

// Calls work(blocks, begin) for the ranges of all vertices, in parallel.
template <class Work>
void for_each_range_of_blocks(const Ground& ground, const GradientOptions& options,
                              unsigned threads, const Work& work) {
  const SolidStars stars(ground, threads);
  bulk::BuilderPool<SolidRings> finders;
  system::parallel_for(threads, ground.num_vertices(), GradientBlocks::vertices_per_piece,
                       [&](std::size_t begin, std::size_t end) {
                         finders.with_builder([&] { return std::make_unique<SolidRings>(stars); },
                                              [&](SolidRings& finder) {
                                                GradientBlocks blocks(ground, finder, options,
                                                                      begin, end);
                                                work(blocks, begin);
                                              });
                       });
}

}  // namespace rondel::interpolation
