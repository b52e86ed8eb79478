// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How the processes of one regridding talk to each other. All make the same calls in the same order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/regrid_files.h"

namespace rondel::formats {

struct RegridRanks {
  using Message = std::vector<std::byte>;

  std::size_t rank = 0;
  std::size_t size = 1;
  // Gives a message to rank 0. There it returns those of all ranks, by rank, and elsewhere nothing.
  std::function<std::vector<Message>(Message)> gather = {};
  // Returns the number that rank 0 has.
  std::function<std::uint64_t(std::uint64_t)> number_of_first = {};

  [[nodiscard]] bool is_first() const { return rank == 0; }
};

// Does the work of regrid_file() together with other processes. Rank 0 writes the output.
RONDEL_API RegridFileReport regrid_by_ranks(const FileName& in, const FileName& target,
                                            const FileName& out, const RegridFileOptions& options,
                                            const RegridRanks& ranks, const Execution& execution);

}  // namespace rondel::formats
