// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The first look at all sites: whether they are valid, and which squares are buckets.
//
// in    a file of sites
// out   buckets of at most so many sites, where that is possible
// index rows of the file; buckets, in the order of the curve
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bulk/all_sites.h"
#include "bulk/bucket_cuts.h"
#include "io/npy_rows.h"
#include "system/job.h"

namespace rondel::distributed {

// So many sites are read at a time: work for all threads, and little memory.
inline constexpr std::size_t most_piece_sites = std::size_t{1} << 20;

struct SiteCounts {
  bulk::AllSites all;
  std::vector<bulk::BucketCut> cuts;
};

// Throws FileError because of the first of these sites, which `first` are before, that is not valid.
void validate_rows(const io::NpyRows& rows, std::span<const Point> sites, const Options& options,
                   std::uint64_t first);

// Throws FileError because of the first row that is not valid.
SiteCounts count_sites(const io::NpyRows& rows, const system::Job& options,
                       std::uint64_t most_bucket_sites, std::size_t piece_sites);

// The keys of some sites, by several threads.
void find_keys(std::span<const Point> sites, const system::Job& options,
               std::span<std::uint64_t> keys);

}  // namespace rondel::distributed
