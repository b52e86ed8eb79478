// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Prepares cells and repairs sides that cross because of rounding alone.
#pragma once

#include <vector>

#include "overlay/subdivision.h"
#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Returns the tidied() cells as a subdivision. The parts of a cover inside of a cell are only known
// if the cell's sides do not cross. Where they do because corners are on sides up to rounding,
// these corners become corners of the sides, in all cells that have them. `whole` has the cells
// that are the whole sphere, before and after.
Subdivision sound_cells(const CellRings& cells, std::vector<Index>& whole,
                        const Execution& execution);

}  // namespace rondel::overlay
