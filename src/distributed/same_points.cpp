// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/same_points.h"

#include <algorithm>
#include <bit>

#include "system/parallel.h"

namespace rondel::distributed {
namespace {

constexpr std::size_t piece_points = std::size_t{1} << 14;

// The table of one piece, at most a quarter full, which the caches hold.
class PointTable {
 public:
  explicit PointTable(std::size_t num_points)
      : shift_(62 - static_cast<int>(std::bit_width(num_points - 1))),
        slots_(std::size_t{1} << (64 - shift_), 0) {}

  // The first of points 0 ... i with the bits of point i, which is looked at after all before it.
  Index first_same(std::span<const Point> points, Index i) {
    const auto bits = bits_of(points[i]);
    for (std::size_t slot = hash(bits) >> shift_;; slot = (slot + 1) % slots_.size()) {
      Index& next = slots_[slot];
      if (next == 0) next = i + 1;
      if (bits_of(points[next - 1]) == bits) return next - 1;
    }
  }

 private:
  // The bits of small integers differ in the upper half only, those of neighbors in the lower one. Any odd
  // factors do whose bits follow no rule.
  static std::uint64_t hash(const PointBits& bits) {
    const std::uint64_t h = bits[0] * 0x9e3779b97f4a7c15U + bits[1] * 0xc2b2ae3d27d4eb4fU +
                            bits[2] * 0x165667b19e3779f9U;
    return (h ^ h >> 32U) * 0x9e3779b97f4a7c15U;
  }

  int shift_;
  std::vector<Index> slots_;  // 0, or a point + 1
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
  // Where samples have none there are few, which may be sent.
  look(true);
  std::vector<PointCopy> copies;
  const auto has_copies = [](const auto& piece) { return !piece.empty(); };
  if (std::ranges::none_of(pieces, has_copies)) return copies;
  look(false);
  for (const auto& piece : pieces) copies.insert(copies.end(), piece.begin(), piece.end());
  return copies;
}

}  // namespace rondel::distributed
