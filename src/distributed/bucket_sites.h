// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the sites of a bucket from its slot. If there are more of them than a bucket may have, all
// of them lie in the smallest square there is; then duplicates are found piece by piece, and one
// site of each place is kept.
//
// in    slots
// out   the sites of a bucket in memory
// index sites of the bucket; rows of the input
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "distributed/result_store.h"
#include "distributed/site_spool.h"
#include "system/job.h"
#include "system/large_arrays.h"

namespace rondel::distributed {

// The sites of a bucket, by their position in it.
struct BucketSites {
  LargeVector<Point> points;
  LargeVector<Point> named_points;  // the points of `rows`, if these are not `points`
  std::vector<std::uint64_t> rows;  // increasing; empty if they are read later, when they are
                                    // needed
};

// The places where the sites of a bucket are stored, and where its duplicates go.
struct BucketFiles {
  const SiteSpool& spool;
  ResultStore& store;
  std::size_t bucket;
  std::uint64_t num_sites;
  SpoolChecksums scattered;
};

// Reads all points, or one of each place if there are more than `max_num_sites`; then the
// duplicates are added to the store. Returns nothing if the slot does not contain what was
// scattered. Throws FileError if more than `max_num_sites` places lie in the smallest square.
std::optional<BucketSites> read_bucket_sites(const BucketFiles& files, std::uint64_t max_num_sites,
                                             const system::Job& options, StoredBucket& stored);

// Returns the row of each vertex, by rank.
std::vector<std::uint64_t> vertex_rows(const order::SpatialOrder& order,
                                       std::span<const std::uint64_t> rows);
// Returns the point of each vertex, by rank. Of duplicates on one ray, it is the point of the
// lowest row, which determines areas.
LargeVector<Point> vertex_points(const order::SpatialOrder& order, const BucketSites& sites);
// Returns the duplicates as rows of the input.
std::vector<DuplicateRow> duplicate_rows(std::span<const Duplicate> duplicates,
                                         std::span<const std::uint64_t> rows);

// Returns all rows of a bucket, or nothing if the slot does not contain what was scattered.
std::optional<std::vector<std::uint64_t>> read_bucket_rows(const BucketFiles& files);

}  // namespace rondel::distributed
