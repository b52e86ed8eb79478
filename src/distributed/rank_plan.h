// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Decides which squares each rank triangulates: an interval of the curve with its share of the
// sites, divided into the largest squares that it contains.
//
//      .---.---.---.---.      Three ranks. The squares in which the sites were counted are small, so
//      | 1 | 1 | 2 | 2 |      that the shares are equal; those of one rank are merged if they fill a
//      |---'---|---|---|      larger one, as fewer faces reach beyond a large square.
//      | 0   0 | 1 | 2 |
//      | 0   0 |---|---|
//      '-------'---'---'
//
// in    squares with their numbers of sites, small beside the share of a rank
// out   buckets
// index buckets of all ranks, along the curve; ranks
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "distributed/bucket_cuts.h"

namespace rondel::distributed {

// The buckets of all ranks.
struct RankPlan {
  std::vector<BucketCut> buckets;
  std::vector<std::size_t> first_bucket;  // by rank; then the number of buckets

  [[nodiscard]] std::size_t num_buckets(std::size_t rank) const {
    return first_bucket[rank + 1] - first_bucket[rank];
  }
};

// Each square goes to the rank in whose share its middle site is. A bucket has more than
// `max_bucket_sites` sites only if it is a single one of the squares.
RankPlan plan_ranks(std::span<const BucketCut> squares, std::size_t num_ranks,
                    std::uint64_t max_bucket_sites);

}  // namespace rondel::distributed
