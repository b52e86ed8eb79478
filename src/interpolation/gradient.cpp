// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/gradient.h"

#include <cstddef>
#include <span>
#include <utility>

#include "exact/vector.h"
#include "interpolation/gradient_blocks.h"
#include "interpolation/linear.h"
#include "system/row_assembly.h"

namespace rondel::interpolation {
namespace {

// The rows of consecutive vertices.
struct RangeOfRows {
  std::vector<std::uint64_t> sizes;
  std::vector<Index> vertices;
  std::vector<Point> weights;
};

// Returns the rows of the vertices of a range.
RangeOfRows rows_of(GradientBlocks& blocks, std::size_t begin) {
  RangeOfRows rows;
  std::vector<std::uint64_t> room = {0};  // begin of the room of each row: one more than its
                                          // neighbors, if it has enough
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    room.push_back(room[i] + blocks.max_neighbors(i) + 1);
  }
  rows.vertices.resize(room.back());
  rows.weights.resize(room.back());
  rows.sizes.assign(blocks.size(), 0);
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
      rows.sizes[i] = neighbors.size() + 1;
    }
  });
  // Closes the gaps of room that was not needed.
  std::uint64_t end = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const std::uint64_t to = end;
    end += rows.sizes[i];
    if (to == room[i]) continue;
    for (std::uint64_t k = 0; k < rows.sizes[i]; ++k) {
      rows.vertices[to + k] = rows.vertices[room[i] + k];
      rows.weights[to + k] = rows.weights[room[i] + k];
    }
  }
  rows.vertices.resize(end);
  rows.weights.resize(end);
  return rows;
}

}  // namespace

GradientRows gradient_rows(const PreparedTriangulation& prepared, const GradientOptions& options,
                           unsigned threads) {
  constexpr std::size_t grain = GradientBlocks::vertices_per_piece;
  std::vector<RangeOfRows> pieces(system::num_pieces(prepared.num_vertices(), grain));
  for_each_range_of_blocks(prepared, options, threads,
                           [&](GradientBlocks& blocks, std::size_t begin) {
                             pieces[begin / grain] = rows_of(blocks, begin);
                           });
  GradientRows rows;
  rows.offsets = system::join_rows(
      threads, prepared.num_vertices(), std::move(pieces),
      [](std::size_t b, const RangeOfRows&, std::size_t k) { return b * grain + k; },
      system::JoinedColumn{&RangeOfRows::vertices, rows.vertices},
      system::JoinedColumn{&RangeOfRows::weights, rows.weights});
  return rows;
}

}  // namespace rondel::interpolation
