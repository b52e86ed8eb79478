// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/gradient.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "exact/vector.h"
#include "interpolation/gradient_blocks.h"
#include "interpolation/linear.h"
#include "system/parallel.h"

namespace rondel::interpolation {
namespace {

// Returns the rows of the vertices of a range.
GradientRows rows_of(GradientBlocks& blocks, std::size_t begin) {
  GradientRows rows;
  std::vector<std::uint64_t> room = {0};  // begin of the room of each row: one more than its
                                          // neighbors, if it has enough
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    room.push_back(room[i] + blocks.most_neighbors(i) + 1);
  }
  rows.vertices.resize(room.back());
  rows.weights.resize(room.back());
  std::vector<std::uint64_t> sizes(blocks.size(), 0);
  blocks.for_each_block([&](const LocalFits& fits, std::span<const Index> members) {
    for (std::size_t lane = 0; lane < members.size(); ++lane) {
      if (!fits.has_gradient(lane)) continue;
      const Index i = members[lane];
      const std::span<const Index> neighbors = blocks.neighbors(i);
      const std::uint64_t first = room[i];
      Vec sum{0, 0, 0};
      for (std::size_t k = 0; k < neighbors.size(); ++k) {
        const Vec weight = fits.weight(lane, k);
        sum = sum + weight;
        rows.vertices[first + k + 1] = neighbors[k];
        rows.weights[first + k + 1] = exact::to_point(weight);
      }
      rows.vertices[first] = static_cast<Index>(begin + i);
      rows.weights[first] = exact::to_point(-1 * sum);
      sizes[i] = neighbors.size() + 1;
    }
  });
  // Closes the gaps of room that was not needed.
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const std::uint64_t to = rows.offsets.back();
    rows.offsets.push_back(to + sizes[i]);
    if (to == room[i]) continue;
    for (std::uint64_t k = 0; k < sizes[i]; ++k) {
      rows.vertices[to + k] = rows.vertices[room[i] + k];
      rows.weights[to + k] = rows.weights[room[i] + k];
    }
  }
  rows.vertices.resize(rows.offsets.back());
  rows.weights.resize(rows.offsets.back());
  return rows;
}

GradientRows joined(const std::vector<GradientRows>& pieces, unsigned threads) {
  GradientRows all;
  std::vector<std::size_t> first_rows;
  std::vector<std::size_t> first_entries;
  std::size_t num_entries = 0;
  std::size_t num_rows = 0;
  for (const GradientRows& piece : pieces) {
    first_rows.push_back(num_rows);
    first_entries.push_back(num_entries);
    num_rows += piece.offsets.size() - 1;
    num_entries += piece.vertices.size();
  }
  all.offsets.resize(num_rows + 1);
  all.vertices.resize(num_entries);
  all.weights.resize(num_entries);
  all.offsets[num_rows] = num_entries;
  system::parallel_for(threads, pieces.size(), 1, [&](std::size_t p, std::size_t /*end*/) {
    const GradientRows& piece = pieces[p];
    const auto entry = static_cast<std::ptrdiff_t>(first_entries[p]);
    for (std::size_t r = 0; r + 1 < piece.offsets.size(); ++r) {
      all.offsets[first_rows[p] + r] = first_entries[p] + piece.offsets[r];
    }
    std::ranges::copy(piece.vertices, all.vertices.begin() + entry);
    std::ranges::copy(piece.weights, all.weights.begin() + entry);
  });
  return all;
}

}  // namespace

GradientRows gradient_rows(const Ground& ground, const GradientOptions& options, unsigned threads) {
  constexpr std::size_t grain = GradientBlocks::vertices_per_piece;
  std::vector<GradientRows> pieces(system::num_pieces(ground.num_vertices(), grain));
  for_each_range_of_blocks(ground, options, threads,
                           [&](GradientBlocks& blocks, std::size_t begin) {
                             pieces[begin / grain] = rows_of(blocks, begin);
                           });
  return joined(pieces, threads);
}

}  // namespace rondel::interpolation
