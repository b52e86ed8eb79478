// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Looks at all sites first: checks that they are valid, and decides which squares are buckets.
//
// in    a file of sites
// out   buckets of at most a given number of sites, where that is possible
// index rows of the file; buckets, in the order of the curve
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bulk/bucket.h"
#include "distributed/bucket_cuts.h"
#include "io/npy_rows.h"
#include "system/job.h"

namespace rondel::distributed {

// The number of sites that are read at a time: enough work for all threads, and little memory.
inline constexpr std::size_t max_piece_sites = std::size_t{1} << 20;

// What is known of all sites, and the buckets.
struct SiteCounts {
  bulk::AllSites all;
  std::vector<BucketCut> cuts;
};

// Throws FileError if one of these sites, the first of which is row `first`, is not valid.
void validate_rows(const io::NpyRows& rows, std::span<const Point> sites, const Options& options,
                   std::uint64_t first);

// Counts the sites of all rows. Throws FileError for the first row that is not valid.
SiteCounts count_sites(const io::NpyRows& rows, const system::Job& options,
                       std::uint64_t max_bucket_sites, std::size_t piece_sites);

// Computes the keys of some sites, by several threads.
void find_keys(std::span<const Point> sites, const system::Job& options,
               std::span<std::uint64_t> keys);

}  // namespace rondel::distributed
