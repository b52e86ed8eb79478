// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sites of a bucket, read from its slot. Where there are more than a bucket may have all of them
// lie in the smallest square there is: then copies are found some at a time, and one of each place is
// kept.
//
// in    slots
// out   the sites of a bucket in memory
// index sites of the bucket; rows of the input
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "distributed/bucket_store.h"
#include "distributed/slots.h"
#include "system/job.h"
#include "system/large_vector.h"

namespace rondel::distributed {

struct BucketSites {
  LargeVector<Point> points;
  LargeVector<Point> named_points;  // of the rows, where these are not the points
  std::vector<std::uint64_t> rows;  // increasing; empty if they are to be read when they are needed
};

// Where the sites of a bucket are, and where their copies go.
struct BucketFiles {
  const Slots& slots;
  BucketStore& store;
  std::size_t bucket;
  std::uint64_t num_sites;
  SlotChecksums dealt;
};

// Reads all points, or those of different places if there are more than may be; then the copies are added to
// the store. Returns nothing if the slot has something else than was dealt. Throws FileError
// if too many sites lie together.
std::optional<BucketSites> read_bucket_sites(const BucketFiles& files, std::uint64_t most_sites,
                                             const system::Job& options, StoredBucket& stored);

// By rank.
std::vector<std::uint64_t> vertex_rows(const order::SpatialOrder& order,
                                       std::span<const std::uint64_t> rows);
// The points of these rows: of copies on one ray the one that names the place, which counts for areas.
LargeVector<Point> vertex_points(const order::SpatialOrder& order, const BucketSites& sites);
std::vector<DuplicateRow> duplicate_rows(std::span<const Duplicate> duplicates,
                                         std::span<const std::uint64_t> rows);

// All rows of a bucket, or nothing, as above.
std::optional<std::vector<std::uint64_t>> read_bucket_rows(const BucketFiles& files);

}  // namespace rondel::distributed
