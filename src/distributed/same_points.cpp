// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/same_points.h"

#include <algorithm>
#include <bit>

#include "system/hash.h"
#include "system/parallel.h"

namespace rondel::distributed {
namespace {

constexpr std::size_t piece_points = std::size_t{1} << 14;

// A hash table for one piece of the points, at most a quarter full, small enough for the caches.
class PointTable {
 public:
  explicit PointTable(std::size_t num_points)
      : shift_(62 - static_cast<int>(std::bit_width(num_points - 1))),
        slots_(std::size_t{1} << (64 - shift_), 0) {}

  // Returns the first of the points 0 ... i with the bits of point i. Call it for all points in
  // order.
  Index first_same(std::span<const Point> points, Index i) {
    const auto bits = bits_of(points[i]);
    for (std::size_t slot = hash(bits) >> shift_;; slot = (slot + 1) % slots_.size()) {
      Index& next = slots_[slot];
      if (next == 0) next = i + 1;
      if (bits_of(points[next - 1]) == bits) return next - 1;
    }
  }

 private:
  // The bits of small integers differ only in their upper half, those of neighboring points in the
  // lower half. Any odd factors without a pattern in their bits will do.
  static std::uint64_t hash(const PointBits& bits) {
    const std::uint64_t h = bits[0] * system::golden_multiplier + bits[1] * 0xc2b2ae3d27d4eb4fU +
                            bits[2] * 0x165667b19e3779f9U;
    return (h ^ h >> 32U) * system::golden_multiplier;
  }

  int shift_;
  std::vector<Index> slots_;  // 0, or 1 + the index of a point
};

void find_in_piece(std::span<const Point> points, std::uint64_t begin,
                   std::vector<PointCopy>& copies) {
  PointTable table(points.size());
  for (Index i = 0; i < points.size(); ++i) {
    const Index first = table.first_same(points, i);
    if (first != i) copies.push_back({begin + i, begin + first});
  }
}

}  // namespace

std::vector<PointCopy> find_copies(std::span<const Point> points, unsigned threads) {
  constexpr std::size_t step = 16;
  const std::size_t num_pieces = system::num_pieces(points.size(), piece_points);
  std::vector<std::vector<PointCopy>> pieces(num_pieces);
  const auto look = [&](bool at_samples) {
    system::parallel_for(threads, num_pieces, 1, [&](std::size_t i, std::size_t /*end*/) {
      if ((i % step == 0) != at_samples) return;
      const std::size_t begin = i * piece_points;
      const std::size_t size = std::min(piece_points, points.size() - begin);
      find_in_piece(points.subspan(begin, size), begin, pieces[i]);
    });
  };
  // If samples have no copies, there are so few that they may be sent.
  look(true);
  std::vector<PointCopy> copies;
  const auto has_copies = [](const auto& piece) { return !piece.empty(); };
  if (std::ranges::none_of(pieces, has_copies)) return copies;
  look(false);
  for (const auto& piece : pieces) copies.insert(copies.end(), piece.begin(), piece.end());
  return copies;
}

}  // namespace rondel::distributed
