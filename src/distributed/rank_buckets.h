// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulates the buckets of one rank, as far as each of them can be by itself.
//
// in    the sites of this rank's buckets
// out   their faces in memory, and what they leave open, as a message
// index buckets of this rank; sites of all ranks, counted through
#pragma once

#include <cstdint>
#include <vector>

#include "bulk/bucket.h"
#include "distributed/rank_sites.h"
#include "rondel/distributed.h"
#include "system/job.h"
#include "system/large_arrays.h"

namespace rondel::distributed {

// The triangulated buckets of this rank.
struct RankBuckets {
  std::vector<bulk::Bucket> buckets;    // without their orders
  std::vector<std::size_t> first_site;  // by bucket: its first element of `sites`; then the end
  LargeVector<std::uint64_t> sites;     // site of each vertex: bucket after bucket, by spatial rank
  LargeVector<Point> points;            // by element of `sites`, if points are kept
  std::vector<std::vector<Point>> open_points;  // by bucket
  std::vector<GlobalDuplicate> duplicates;      // in no particular order
  std::vector<std::uint64_t> hidden;            // hidden whatever other buckets contain; in no
                                                // order

  // Returns the site of open site s of a bucket.
  [[nodiscard]] std::uint64_t open_site(std::size_t bucket, std::size_t s) const {
    return sites[first_site[bucket] + buckets[bucket].border.open_sites[s].rank];
  }
  [[nodiscard]] std::span<const std::uint64_t> sites_of(std::size_t bucket) const {
    return std::span(sites).subspan(first_site[bucket],
                                    first_site[bucket + 1] - first_site[bucket]);
  }
  [[nodiscard]] std::span<const Point> points_of(std::size_t bucket) const {
    return std::span(points).subspan(first_site[bucket],
                                     first_site[bucket + 1] - first_site[bucket]);
  }
  // Returns the open sites of all buckets, in their order.
  [[nodiscard]] std::vector<std::uint64_t> open_sites() const;
  // Returns the points of open_sites(), or nothing if points are not kept.
  [[nodiscard]] std::vector<Point> kept_open_points() const;
};

// Triangulates the buckets of the plan from `first_bucket` on.
RankBuckets triangulate_buckets(const RankSites& sites, const RankCounts& counts,
                                std::size_t first_bucket, std::size_t num_buckets, bool keep_points,
                                const system::Job& options);

// Returns the message with what the buckets leave open, to be joined.
Bytes write_open_buckets(const RankBuckets& own, bool keep_points);

// The open parts of the buckets of all ranks: the buckets in the order of the curve, and their open
// sites. The points of buckets are those that represent their places in ties; among duplicates, the
// lowest site may be another point on the same ray.
struct OpenBuckets {
  std::vector<bulk::OpenBucket> buckets;
  std::vector<std::uint64_t> sites;
  std::vector<Point> points;  // by element of `sites`, if points are kept
};

// Adds the message of a rank. `cuts` are the rank's buckets.
void read_open_buckets(MessageReader& reader, std::span<const BucketCut> cuts, bool keep_points,
                       OpenBuckets& all);

}  // namespace rondel::distributed
