// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// First each square gets a rank; then the faces of the cube are divided until a square belongs to
// one rank and does not have too many sites.

#include "distributed/rank_plan.h"

#include <algorithm>

namespace rondel::distributed {
namespace {

using order::high_levels;

// Returns the rank of each square, by the position of its middle site among all.
std::vector<std::size_t> ranks_of(std::span<const BucketCut> squares, std::size_t num_ranks) {
  double num_all = 0;
  for (const BucketCut& square : squares) num_all += static_cast<double>(square.num_sites);
  std::vector<std::size_t> ranks;
  double before = 0;
  for (const BucketCut& square : squares) {
    const auto num_sites = static_cast<double>(square.num_sites);
    const double share = (before + num_sites / 2) / num_all * static_cast<double>(num_ranks);
    ranks.push_back(std::min(static_cast<std::size_t>(share), num_ranks - 1));
    before += num_sites;
  }
  return ranks;
}

// Walks along the curve and merges the squares of one rank. next_ is the first square that is in no
// bucket yet.
class Planner {
 public:
  Planner(std::span<const BucketCut> squares, std::span<const std::size_t> ranks,
          std::uint64_t max_num_sites)
      : squares_(squares), ranks_(ranks), max_sites_(max_num_sites) {}

  // Adds the buckets of a square that results from `level` divisions of a face of the cube.
  void add(const bulk::Square& square, std::uint64_t first_key, int level) {
    const std::uint64_t num_keys = std::uint64_t{1} << (2 * (high_levels - level));
    const std::size_t begin = next_;
    std::size_t end = begin;
    std::uint64_t num_sites = 0;
    for (; end < squares_.size() && squares_[end].first_key - first_key < num_keys; ++end)
      num_sites += squares_[end].num_sites;
    if (begin == end) return;
    const bool is_of_one = ranks_[begin] == ranks_[end - 1];
    if (is_of_one && (num_sites <= max_sites_ || end - begin == 1)) {
      buckets_.push_back({square, first_key, num_sites});
      bucket_ranks_.push_back(ranks_[begin]);
      next_ = end;
      return;
    }
    for (unsigned rank = 0; rank < 4; ++rank)
      add(bulk::quadrant(square, rank), first_key + rank * (num_keys / 4), level + 1);
  }

  RankPlan take(std::size_t num_ranks) {
    RankPlan plan = {std::move(buckets_), {}};
    for (std::size_t rank = 0; rank <= num_ranks; ++rank) {
      const auto first = std::ranges::lower_bound(bucket_ranks_, rank);
      plan.first_bucket.push_back(static_cast<std::size_t>(first - bucket_ranks_.begin()));
    }
    return plan;
  }

 private:
  std::span<const BucketCut> squares_;
  std::span<const std::size_t> ranks_;
  std::uint64_t max_sites_;
  std::size_t next_ = 0;
  std::vector<BucketCut> buckets_;
  std::vector<std::size_t> bucket_ranks_;
};

}  // namespace

RankPlan plan_ranks(std::span<const BucketCut> squares, std::size_t num_ranks,
                    std::uint64_t max_bucket_sites) {
  const std::vector<std::size_t> ranks = ranks_of(squares, num_ranks);
  Planner planner(squares, ranks, max_bucket_sites);
  for (unsigned face = 0; face < 6; ++face) {
    planner.add({{face, 0, 0}, order::position_bits, 0}, std::uint64_t{face} << (2 * high_levels),
                0);
  }
  return planner.take(num_ranks);
}

}  // namespace rondel::distributed
