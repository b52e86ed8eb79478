// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes overlapping cells disjoint, in their order or by merging them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "overlay/cell_set_data.h"
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

// Returns the cells with each set of overlapping cells merged: the first cell of a set becomes the
// union, the others become empty. Returns nothing if no cells overlap. Throws InvalidInput, with
// `what` for the cells, if a cell overlaps itself.
std::optional<CellSet> united(const CellSetData& cells, const char* what,
                              const Execution& execution);

}  // namespace rondel::overlay
