// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Constraints that may cross, as constraints that do not.
//
// in    sites and constraints, in the order of the input
// out   sites, of which new ones come last, constraints between them, and where they come from
// index sites; constraints given and made
#pragma once

#include <array>
#include <span>
#include <vector>

#include "rondel/compressed_rows.h"
#include "rondel/sites.h"
#include "rondel/types.h"

namespace rondel::constrained {

struct SplitConstraints {
  Sites sites;
  std::vector<std::array<Index, 2>> ends;
  CompressedRows<Index> sources;  // the given constraints of each one that was made
};

// Throws InvalidInput as arrange() does.
SplitConstraints split_constraints(const Sites& sites,
                                   std::span<const std::array<Index, 2>> constraints,
                                   const Execution& execution);

}  // namespace rondel::constrained
