// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where the sites of the buckets lie in one file: a slot for each bucket, the points first and then the
// indices, both in the order of the input.
//
// in    a file of sites
// out   the sites of one bucket after the other
// index buckets; rows of the input; sites of a bucket
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "distributed/checksum.h"
#include "distributed/scratch_file.h"
#include "distributed/site_counts.h"

namespace rondel::distributed {

inline constexpr std::uint64_t slot_bytes = 32;  // of a site

// Of all points, and of all rows, of a bucket.
struct SlotChecksums {
  std::uint64_t points = 0;
  std::uint64_t rows = 0;
};

class Slots {
 public:
  Slots(const std::string& path, std::span<const bulk::BucketCut> cuts);

  // Deals the sites of those buckets that are wanted; the first row is called `first_number`. Returns the checksums of each of all buckets.
  std::vector<SlotChecksums> deal(const io::NpyRows& rows, const system::Job& options,
                                  const std::vector<bool>& wanted, std::size_t piece_sites,
                                  std::uint64_t first_number);

  // Some of the sites of a bucket, from `first` on.
  void read_points(std::size_t bucket, std::uint64_t first, std::span<Point> points) const;
  void read_rows(std::size_t bucket, std::uint64_t first, std::span<std::uint64_t> rows) const;

 private:
  class DealtSites;

  [[nodiscard]] std::uint64_t points_at(std::size_t bucket) const {
    return slot_bytes * first_site_[bucket];
  }
  [[nodiscard]] std::uint64_t rows_at(std::size_t bucket) const {
    return points_at(bucket) + sizeof(Point) * cuts_[bucket].num_sites;
  }

  ScratchFile file_;
  std::span<const bulk::BucketCut> cuts_;
  std::vector<std::uint64_t> first_site_;  // of each bucket, and behind the last one
};

}  // namespace rondel::distributed
