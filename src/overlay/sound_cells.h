// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells whose sides do not cross, as far as rounding alone has made them.
#pragma once

#include <vector>

#include "overlay/subdivision.h"
#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The tidied() cells. Which parts of a cover are inside of a cell is only known if its sides do not cross: where they do and
// corners are on sides to rounding, these become corners of the sides, in all cells that have them. `whole` are the cells
// that are the whole sphere, before and after.
Subdivision sound_cells(const CellRings& cells, std::vector<Index>& whole,
                        const Execution& execution);

}  // namespace rondel::overlay
