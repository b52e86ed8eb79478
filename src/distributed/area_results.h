// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The array of areas, which are found bucket by bucket and written row by row.
//
// in    areas of vertices
// out   the areas of all sites
// index rows of the input
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "distributed/bucket_store.h"
#include "distributed/result_array.h"
#include "distributed/scratch_file.h"

namespace rondel::distributed {

class AreaResults {
 public:
  // A scratch file between the two.
  AreaResults(std::unique_ptr<ResultArray> result, const std::string& scratch);

  void reserve(std::uint64_t num_sites);
  // Those of some vertices, in any order.
  void add(std::span<const std::uint64_t> rows, std::span<const double> areas);
  // Writes those of all sites, whose rows are counted from `first_row` on; 0 for those without one.
  void write(std::uint64_t num_sites, std::uint64_t first_row);
  void commit() { array_->commit(); }

 private:
  std::unique_ptr<ResultArray> array_;
  ScratchFile scratch_;
  std::vector<std::uint64_t> begin_ = {0};  // of each list, and the end of the last one
};

}  // namespace rondel::distributed
