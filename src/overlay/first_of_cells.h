// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes overlapping cells disjoint.
#pragma once

#include <span>

#include "rondel/cell_rings.h"
#include "rondel/regions.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Returns the cells and one more: the complement of their union. Precondition: no two cells
// overlap.
CellRings with_outside(CellRings cells, const Execution& execution);

// Assigns each place to the first cell that has it, and returns the cells. `overlaps` are the
// overlapping_cells() of `cells`. Precondition: no cell overlaps itself.
CellRings first_of_cells(const CellRings& cells, std::span<const CrossingCells> overlaps,
                         const Execution& execution);

}  // namespace rondel::overlay
