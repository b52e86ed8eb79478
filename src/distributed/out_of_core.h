// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A run from a file of sites to files of results, with what it may have in memory at once.
//
//     count        how many sites each square has          rows -> cuts
//     deal         the sites of each bucket together       rows -> slots
//     triangulate  one bucket after the other              slots -> store
//     join         what the buckets left open, in memory
//     write        the faces, bucket by bucket             store -> results
//
// in    a file of sites; a directory where an earlier run may have begun
// out   the files of the result
// index rows of the input; buckets
#pragma once

#include <cstdint>
#include <string>

#include "io/npy_rows.h"
#include "rondel/out_of_core.h"
#include "system/job.h"

namespace rondel::distributed {

// What may be in memory at once.
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

OutOfCoreReport run(const io::NpyRows& rows, const OutOfCoreFiles& files,
                    const OutOfCoreOptions& out_of_core, const RunLimits& limits,
                    const system::Job& options);

}  // namespace rondel::distributed
