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

#include "distributed/run_limits.h"
#include "io/npy_rows.h"
#include "rondel/out_of_core.h"
#include "system/job.h"

namespace rondel::distributed {

OutOfCoreReport run(const io::NpyRows& rows, const OutOfCoreFiles& files,
                    const OutOfCoreOptions& out_of_core, const RunLimits& limits,
                    const system::Job& options);

}  // namespace rondel::distributed
