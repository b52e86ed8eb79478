// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a run out of core may have in memory at once, and what it would need for more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace rondel::distributed {

struct RunLimits {
  std::uint64_t most_bucket_sites = 0;  // where squares can be smaller
  std::uint64_t most_sites = 0;         // where they cannot, copies not counted
  std::uint64_t most_open_sites = 0;    // of all buckets
  std::size_t piece_sites = 0;          // while they are read
  // What the first site and the first face are called: not 0 in tests of numbers that need 64 bits.
  std::uint64_t first_number = 0;
};

// What these bytes allow. Throws InvalidInput if they are too few.
RunLimits limits_of(std::uint64_t memory);

// The memory that allows so many, as a text: "123 MB".
std::string memory_of_bucket(std::uint64_t num_sites);
std::string memory_of_crowd(std::uint64_t num_sites);
std::string memory_of_open_sites(std::uint64_t num_sites);

}  // namespace rondel::distributed
