// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes the array of areas, which are computed bucket by bucket and written row by row, by way of
// a scratch file.
//
// in    areas of vertices
// out   the areas of all sites
// index rows of the input
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "distributed/result_array.h"
#include "distributed/result_store.h"
#include "distributed/scratch_file.h"

namespace rondel::distributed {

// Collects areas and writes them in the order of rows.
class AreaResults {
 public:
  // The areas are kept in the scratch file until write().
  AreaResults(const std::string& path, const std::string& scratch);

  // Reserves disk space for the areas of `num_sites` sites.
  void reserve(std::uint64_t num_sites);
  // Adds the areas of some vertices, in any order.
  void add(std::span<const std::uint64_t> rows, std::span<const double> areas);
  // Writes the areas of all sites, whose rows are counted from `first_row` on; a site without an
  // area gets 0.
  void write(std::uint64_t num_sites, std::uint64_t first_row);
  // Gives the file its name.
  void commit() { array_.commit(); }

 private:
  ResultArray array_;
  ScratchFile scratch_;
  std::vector<std::uint64_t> begin_ = {0};  // by list: where it begins in the scratch file; then
                                            // the end of the last one
};

}  // namespace rondel::distributed
