// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Looks at the sites of all ranks first: checks that they are valid, counts them by squares, and
// decides which squares each rank triangulates.
//
// in    the sites of each rank
// out   the same plan on each rank
// index sites of this rank; sites of all ranks, counted through
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bulk/bucket.h"
#include "distributed/bsp_session.h"
#include "distributed/rank_plan.h"
#include "distributed/same_points.h"
#include "system/job.h"

namespace rondel::distributed {

// Limits that tests set, in addition to the options of users.
struct RankLimits {
  std::uint64_t max_bucket_sites = 0;
  std::uint64_t max_scattered_sites = 0;
  // The number of the first site and of the first face. Tests set it to see that 64 bits arrive
  // everywhere.
  std::uint64_t first_number = 0;
  bool keep_points = false;
};

// Returns the rank that gave a site, where the sites of rank r begin at first_site[r].
inline std::size_t rank_of_site(std::uint64_t site, std::span<const std::uint64_t> first_site) {
  const auto next = std::ranges::upper_bound(first_site, site);
  return static_cast<std::size_t>(next - first_site.begin()) - 1;
}

// The result of counting, which is the same on each rank but for copies and keys.
struct RankCounts {
  std::vector<std::uint64_t> first_site;  // by rank, from 0 on; then the number of all sites
  bulk::AllSites all;
  RankPlan plan;
  std::vector<PointCopy> copies;    // copies among this rank's sites, which are neither counted nor
                                    // scattered
  std::vector<std::uint64_t> keys;  // keys of this rank's other sites

  [[nodiscard]] std::uint64_t num_sites(std::size_t rank) const {
    return first_site[rank + 1] - first_site[rank];
  }
};

// Counts the sites. Throws InvalidInput on all ranks if a site of any rank is not valid.
RankCounts count_on_ranks(BspSession& session, std::span<const Point> mine,
                          const RankLimits& limits, const system::Job& options);

}  // namespace rondel::distributed
