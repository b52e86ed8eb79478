// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells that overlap made disjoint.
#pragma once

#include <span>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/regions.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The cells, and one more that is all that is in none of them. Precondition: no two overlap.
RONDEL_API CellRings with_outside(CellRings cells, const Execution& execution);

// Leaves a place that is in several cells to the first of them. `overlaps` are their overlapping_cells(); no cell overlaps itself.
CellRings first_of_cells(const CellRings& cells, std::span<const CrossingCells> overlaps,
                         const Execution& execution);

}  // namespace rondel::overlay
