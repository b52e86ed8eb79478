// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sites of the buckets in one file: a slot for each bucket, which has the points first and then
// the row numbers, both in the order of the input.
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

inline constexpr std::uint64_t slot_bytes = 32;  // bytes of a site

// Checksums of all points and of all rows of a bucket.
struct SpoolChecksums {
  std::uint64_t points = 0;
  std::uint64_t rows = 0;
};

// A file with a slot for each bucket.
class SiteSpool {
 public:
  SiteSpool(const std::string& path, std::span<const BucketCut> cuts);

  // Distributes the sites to the slots of the buckets that are wanted; the first row has the number
  // `first_number`. Returns the checksums of all buckets.
  std::vector<SpoolChecksums> scatter(const io::NpyRows& rows, const system::Job& options,
                                      const std::vector<bool>& wanted, std::size_t piece_sites,
                                      std::uint64_t first_number);

  // Read some of the sites of a bucket, from site `first` of it on.
  void read_points(std::size_t bucket, std::uint64_t first, std::span<Point> points) const;
  void read_rows(std::size_t bucket, std::uint64_t first, std::span<std::uint64_t> rows) const;

 private:
  class ScatteredSites;

  [[nodiscard]] std::uint64_t points_at(std::size_t bucket) const {
    return slot_bytes * first_site_[bucket];
  }
  [[nodiscard]] std::uint64_t rows_at(std::size_t bucket) const {
    return points_at(bucket) + sizeof(Point) * cuts_[bucket].num_sites;
  }

  ScratchFile file_;
  std::span<const BucketCut> cuts_;
  std::vector<std::uint64_t> first_site_;  // by bucket; then the number of all sites
};

}  // namespace rondel::distributed
