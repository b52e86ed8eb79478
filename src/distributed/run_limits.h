// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How many sites a run out of core may have in memory at once, and how much memory more would take.
//
// in    bytes of memory
// out   numbers of sites
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace rondel::distributed {

// The largest numbers of sites that are in memory at once.
struct RunLimits {
  std::uint64_t max_bucket_sites = 0;  // in a bucket that can be divided
  std::uint64_t max_num_sites = 0;     // in a bucket of the smallest size, without duplicates
  std::uint64_t max_open_sites = 0;    // in all buckets together
  std::size_t piece_sites = 0;         // number of sites that are read at a time
  // The number of the first site and of the first face; tests of numbers that need 64 bits set it.
  std::uint64_t first_number = 0;
};

// Returns the limits for `memory` bytes. Throws InvalidInput if that is too little.
RunLimits limits_of(std::uint64_t memory);

// Return the memory that allows that many sites in a bucket, in the smallest square, or open, as a
// text: "123 MB".
std::string memory_of_bucket(std::uint64_t num_sites);
std::string memory_of_crowd(std::uint64_t num_sites);
std::string memory_of_open_sites(std::uint64_t num_sites);

}  // namespace rondel::distributed
