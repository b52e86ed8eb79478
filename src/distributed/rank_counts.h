// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The first look at the sites of all ranks: whether they are valid, how many there are in which squares,
// and so which squares each rank triangulates.
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

#include "bulk/all_sites.h"
#include "distributed/rank_plan.h"
#include "distributed/same_points.h"
#include "distributed/supersteps.h"
#include "system/job.h"

namespace rondel::distributed {

// What tests set, beside what users may.
struct RankLimits {
  std::uint64_t most_bucket_sites = 0;
  std::uint64_t most_dealt_sites = 0;
  // What the first site and the first face of all are called: not 0 where a test wants to see that 64
  // bits arrive everywhere.
  std::uint64_t first_number = 0;
  bool keep_points = false;
};

// Which rank gave a site, where those of rank r begin at first_site[r].
inline std::size_t rank_of_site(std::uint64_t site, std::span<const std::uint64_t> first_site) {
  const auto next = std::ranges::upper_bound(first_site, site);
  return static_cast<std::size_t>(next - first_site.begin()) - 1;
}

struct RankCounts {
  std::vector<std::uint64_t> first_site;  // of each rank, and behind the last one, from 0 on
  bulk::AllSites all;
  RankPlan plan;
  std::vector<PointCopy> copies;    // of this rank's sites, which are not counted and not dealt
  std::vector<std::uint64_t> keys;  // of its other sites

  [[nodiscard]] std::uint64_t num_sites(std::size_t rank) const {
    return first_site[rank + 1] - first_site[rank];
  }
};

RankCounts count_on_ranks(Supersteps& steps, std::span<const Point> mine, const RankLimits& limits,
                          const system::Job& options);

}  // namespace rondel::distributed
