// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Merges cells that overlap.
#pragma once

#include <optional>
#include <vector>

#include "overlay/cell_set_data.h"
#include "rondel/regions.h"

namespace rondel::overlay {

// Returns the cells with each set of overlapping cells merged: the first cell of a set becomes the
// union, the others become empty. Returns nothing if no cells overlap. Throws InvalidInput, with
// `what` for the cells, if a cell overlaps itself.
std::optional<CellSet> united(const CellSetData& cells, const char* what,
                              const Execution& execution);

}  // namespace rondel::overlay
