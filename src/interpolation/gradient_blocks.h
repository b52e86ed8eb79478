// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The local fits of many vertices (local_fit.h), several at once. Vertices with about as many
// neighbors share lanes, so that few entries of a lane are idle.
//
// in    a range of vertices
// out   the fits of all of them, a block of LocalFits::lanes at a time
// index i: position of a vertex in the range; vertices by spatial rank
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "bulk/builder_pool.h"
#include "interpolation/local_fit.h"
#include "interpolation/prepared_triangulation.h"
#include "interpolation/solid_rings.h"
#include "rondel/interpolate.h"
#include "rondel/types.h"
#include "system/parallel.h"

namespace rondel::interpolation {

// The fits of the vertices begin ... end - 1.
class GradientBlocks {
 public:
  // The number of vertices that one thread takes at a time: their data fit the first-level cache.
  static constexpr std::size_t vertices_per_piece = 256;

  GradientBlocks(const PreparedTriangulation& prepared, SolidRings& finder,
                 const GradientOptions& options, std::size_t begin, std::size_t end);

  [[nodiscard]] std::size_t size() const { return starts_.size() - 1; }
  // Returns an upper bound of the number of neighbors of vertex i of the range.
  [[nodiscard]] std::size_t max_neighbors(std::size_t i) const {
    return starts_[i + 1] - starts_[i];
  }

  // Calls take(fits, members) for each block; members[lane] is the position in the range of the
  // vertex of that lane.
  template <class Take>
  void for_each_block(const Take& take) {
    for (std::size_t at = 0; at < size(); at += LocalFits::lanes) {
      const std::span members(&order_[at], std::min(LocalFits::lanes, size() - at));
      fit(members);
      take(fits_, members);
    }
  }
  // Returns the neighbors that the fit of vertex i used. Precondition: its block has been taken.
  [[nodiscard]] std::span<const Index> neighbors(std::size_t i) const {
    return {neighbors_.data() + starts_[i], num_near_[i]};
  }

 private:
  void sort_by_size();
  void fit(std::span<const Index> members);
  void add_neighbors(std::size_t lane, std::size_t i);

  const PreparedTriangulation& prepared_;
  bool with_lines_;
  std::size_t begin_;
  std::vector<Index> neighbors_;  // of all vertices, one after the other; blocks take out those
                                  // that are too far
  std::vector<std::size_t> starts_ = {0};
  std::vector<std::size_t> num_near_;
  std::vector<Index> order_;
  LocalFits fits_;
};

// Calls work(blocks, begin) for ranges that cover all vertices, in parallel.
template <class Work>
void for_each_range_of_blocks(const PreparedTriangulation& prepared, const GradientOptions& options,
                              unsigned threads, const Work& work) {
  const SolidStars stars(prepared, threads);
  bulk::BuilderPool<SolidRings> finders;
  system::parallel_for(threads, prepared.num_vertices(), GradientBlocks::vertices_per_piece,
                       [&](std::size_t begin, std::size_t end) {
                         finders.with_builder([&] { return std::make_unique<SolidRings>(stars); },
                                              [&](SolidRings& finder) {
                                                GradientBlocks blocks(prepared, finder, options,
                                                                      begin, end);
                                                work(blocks, begin);
                                              });
                       });
}

}  // namespace rondel::interpolation
