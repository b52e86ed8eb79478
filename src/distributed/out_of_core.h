// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A run from a file of sites to result files, within a given amount of memory.
//
//     count        counts the sites of each square               rows -> cuts
//     scatter      moves the sites of each bucket together       rows -> spool
//     triangulate  triangulates one bucket after the other       spool -> store
//     join         joins what the buckets left open, in memory
//     write        writes the faces, bucket by bucket            store -> results
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

// Runs all steps and returns the counts. Throws FileError for bad or unreadable files, and
// InvalidInput for options.
OutOfCoreReport run(const io::NpyRows& rows, const OutOfCoreFiles& files,
                    const OutOfCoreOptions& out_of_core, const RunLimits& limits,
                    const system::Job& options);

}  // namespace rondel::distributed
