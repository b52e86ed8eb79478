// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "distributed/run_limits.h"

#include <algorithm>

#include "distributed/site_counts.h"
#include "rondel/error.h"
#include "rondel/types.h"

namespace rondel::distributed {
namespace {

// The memory of the process itself and of the counts of squares.
constexpr std::uint64_t fixed_bytes = std::uint64_t{64} << 20;
constexpr std::uint64_t bytes_of_piece_site = 80;
// These were measured, and rounded up (bench/RESULTS.md, "Out of core").
constexpr std::uint64_t bytes_of_bucket_site = 115;
constexpr std::uint64_t bytes_of_crowded_site = 250;  // within 2^-28 of all others of its bucket
constexpr std::uint64_t bytes_of_open_site = 330;
constexpr std::uint64_t min_memory = std::uint64_t{96} << 20;

std::string in_megabytes(std::uint64_t bytes) {
  return std::to_string((bytes + (1U << 20U) - 1) >> 20U) + " MB";
}

std::string memory_of(std::uint64_t num_sites, std::uint64_t bytes_of_site) {
  return in_megabytes(std::max(fixed_bytes + bytes_of_site * num_sites, min_memory));
}

}  // namespace

RunLimits limits_of(std::uint64_t memory) {
  if (memory < min_memory) {
    throw InvalidInput(in_megabytes(memory) + " of memory are less than the " +
                           in_megabytes(min_memory) + " that are needed at least",
                       0);
  }
  const std::uint64_t bytes = memory - fixed_bytes;
  RunLimits limits;
  limits.max_bucket_sites = std::min<std::uint64_t>(bytes / bytes_of_bucket_site, max_sites);
  limits.max_num_sites = std::min<std::uint64_t>(bytes / bytes_of_crowded_site, max_sites);
  limits.max_open_sites = std::min<std::uint64_t>(bytes / bytes_of_open_site, max_sites);
  limits.piece_sites = std::min<std::size_t>(bytes / 2 / bytes_of_piece_site, max_piece_sites);
  return limits;
}

std::string memory_of_bucket(std::uint64_t num_sites) {
  return memory_of(num_sites, bytes_of_bucket_site);
}

std::string memory_of_crowd(std::uint64_t num_sites) {
  return memory_of(num_sites, bytes_of_crowded_site);
}

std::string memory_of_open_sites(std::uint64_t num_sites) {
  return memory_of(num_sites, bytes_of_open_site);
}

}  // namespace rondel::distributed
