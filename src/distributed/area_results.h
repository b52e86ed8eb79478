// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The file of areas, which are found bucket by bucket and written row by row.
//
// in    areas of vertices
// out   a .npy file of the areas of all sites
// index rows of the input
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "distributed/bucket_store.h"
#include "distributed/scratch_file.h"
#include "io/atomic_file.h"

namespace rondel::distributed {

class AreaResults {
 public:
  // A scratch file between the two.
  AreaResults(const std::string& result, const std::string& scratch);

  void reserve(std::uint64_t num_sites);
  // Those of some vertices, in any order.
  void add(std::span<const std::uint64_t> rows, std::span<const double> areas);
  // Writes those of all sites, whose rows are counted from `first_row` on; 0 for those without one.
  void write(std::uint64_t num_sites, std::uint64_t first_row);
  void commit() { file_.commit(); }

 private:
  io::AtomicFile file_;
  ScratchFile scratch_;
  std::vector<std::uint64_t> begin_ = {0};  // of each list, and the end of the last one
};

}  // namespace rondel::distributed
