// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Counts are kept in tables: the first has a count for each square of one level, others divide
// single squares that turned out to be dense. cuts() then walks from the six faces of the cube down
// to the largest squares that do not have too many sites.

#include "distributed/bucket_cuts.h"

#include <algorithm>
#include <numeric>

#include "order/hilbert.h"

namespace rondel::distributed {
namespace {

using order::high_levels;

// The levels by which a dense square is divided in the next round.
constexpr int next_depth = 5;

// Returns the number of squares into which so many levels divide a square.
constexpr std::size_t num_squares(int depth) { return std::size_t{1} << (2 * depth); }

// The number of a square of this level, along the whole curve.
constexpr std::uint64_t square_of(std::uint64_t high_key, int level) {
  return high_key >> (2 * (high_levels - level));
}

}  // namespace

BucketCounts::BucketCounts(std::uint64_t max_num_sites, int depth)
    : max_sites_(std::max<std::uint64_t>(max_num_sites, 1)) {
  const std::size_t size = 6 * num_squares(depth);
  tables_.push_back(
      {depth, depth, std::vector<std::uint64_t>(size, 0), std::vector<Index>(size, no_index)});
}

void BucketCounts::add(std::span<const std::uint64_t> high_keys) {
  const int first_level = tables_.front().level;
  for (const std::uint64_t key : high_keys) {
    Index table = 0;
    auto place = static_cast<std::size_t>(square_of(key, first_level));
    while (tables_[table].finer[place] != no_index) {
      table = tables_[table].finer[place];
      const Table& finer = tables_[table];
      place =
          static_cast<std::size_t>(square_of(key, finer.level) & (num_squares(finer.depth) - 1));
    }
    if (table >= num_old_) ++tables_[table].counts[place];
  }
}

std::vector<std::uint64_t> BucketCounts::counts_of_round() const {
  std::vector<std::uint64_t> result;
  for (const Table& table : std::span(tables_).subspan(num_old_))
    result.insert(result.end(), table.counts.begin(), table.counts.end());
  return result;
}

void BucketCounts::set_counts_of_round(std::span<const std::uint64_t> counts) {
  for (Table& table : std::span(tables_).subspan(num_old_)) {
    std::ranges::copy(counts.first(table.counts.size()), table.counts.begin());
    counts = counts.subspan(table.counts.size());
  }
}

bool BucketCounts::end_round() {
  const std::size_t end = tables_.size();
  for (std::size_t i = num_old_; i < end; ++i) refine(static_cast<Index>(i));
  num_old_ = end;
  return tables_.size() != end;
}

void BucketCounts::refine(Index table) {
  const int level = tables_[table].level;
  if (level == high_levels) return;
  const int depth = std::min(next_depth, high_levels - level);
  for (std::size_t i = 0; i < tables_[table].counts.size(); ++i) {
    if (tables_[table].counts[i] <= max_sites_) continue;
    tables_[table].finer[i] = static_cast<Index>(tables_.size());
    const std::size_t size = num_squares(depth);
    tables_.push_back({level + depth, depth, std::vector<std::uint64_t>(size, 0),
                       std::vector<Index>(size, no_index)});
  }
}

std::vector<BucketCut> BucketCounts::cuts() const {
  std::vector<BucketCut> result;
  const int depth = tables_.front().depth;
  for (unsigned face = 0; face < 6; ++face) {
    cut(0, {{face, 0, 0}, order::position_bits, 0}, std::uint64_t{face} << (2 * high_levels),
        face * num_squares(depth), depth, result);
  }
  return result;
}

void BucketCounts::cut(Index table, const bulk::Square& square, std::uint64_t first_key,
                       std::size_t begin, int depth, std::vector<BucketCut>& cuts) const {
  const auto first = tables_[table].counts.begin() + static_cast<std::ptrdiff_t>(begin);
  const std::uint64_t num_sites = std::accumulate(
      first, first + static_cast<std::ptrdiff_t>(num_squares(depth)), std::uint64_t{0});
  if (num_sites == 0) return;
  const Index finer = depth == 0 ? tables_[table].finer[begin] : no_index;
  if (finer != no_index) return cut(finer, square, first_key, 0, tables_[finer].depth, cuts);
  if (num_sites <= max_sites_ || depth == 0) {
    cuts.push_back({square, first_key, num_sites});
    return;
  }
  const int level = tables_[table].level - depth + 1;  // of the quarters
  for (unsigned rank = 0; rank < 4; ++rank) {
    cut(table, bulk::quadrant(square, rank),
        first_key + (std::uint64_t{rank} << (2 * (high_levels - level))),
        begin + rank * num_squares(depth - 1), depth - 1, cuts);
  }
}

std::size_t bucket_of(std::uint64_t high_key, std::span<const BucketCut> cuts) {
  const auto next = std::ranges::upper_bound(cuts, high_key, {}, &BucketCut::first_key);
  return static_cast<std::size_t>(next - cuts.begin()) - 1;
}

}  // namespace rondel::distributed
