// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes the result files from the stored buckets: computes the faces between buckets, numbers all
// faces, and writes them bucket by bucket.
//
// in    all buckets, stored
// out   the files of the result
// index buckets; rows of the input; faces of the result
#pragma once

#include <optional>

#include "distributed/area_results.h"
#include "distributed/bucket_faces.h"
#include "distributed/row_file.h"
#include "distributed/run_state.h"
#include "rondel/out_of_core.h"
#include "system/job.h"

namespace rondel::distributed {

// The result files while they have temporary names.
struct FileResults {
  // Areas are computed by way of a file in the scratch directory.
  FileResults(const OutOfCoreFiles& files, const std::string& area_scratch);

  // Reserves disk space for the results of `num_sites` sites, whose first number is `first_number`.
  void reserve(std::uint64_t num_sites, std::uint64_t first_number);
  // Gives all files their names.
  void commit();

  RowFile faces;
  std::optional<RowFile> ghost_faces;
  std::optional<RowFile> neighbors;
  std::optional<RowFile> duplicates;
  std::optional<AreaResults> areas;
};

// Joins the buckets and writes the results. Adds counts to `report`. The first site and the first
// face have the number `first_number`.
void write_results(const RunState& state, const ResultStore& store, std::uint64_t first_number,
                   const system::Job& options, FileResults& results, OutOfCoreReport& report);

}  // namespace rondel::distributed
