// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Many set operations that do not change each other.
#pragma once

#include <cstddef>
#include <functional>

#include "rondel/cell_rings.h"
#include "rondel/set_operations.h"
#include "rondel/types.h"

namespace rondel::arrangement {

struct Operands {
  CellRings first;
  CellRings second;
};

// Returns some cells with the points of their corners alone.
CellRings extracted(const CellRings& cells, std::size_t begin, std::size_t end);

// Computes combine() of operands_of(0), operands_of(1) ..., which any thread may call in any order.
// Each result is a cell.
CellRings combined_each(std::size_t count, const std::function<Operands(std::size_t)>& operands_of,
                        SetOperation operation, const Execution& execution);

}  // namespace rondel::arrangement
