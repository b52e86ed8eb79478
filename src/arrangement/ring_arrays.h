// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The check of rings that come from outside.
#pragma once

#include <algorithm>

#include "rondel/cell_rings.h"
#include "rondel/error.h"
#include "system/row_assembly.h"

namespace rondel::arrangement {

// Throws InvalidInput if the arrays are no compressed rows.
inline void validate_rings(const CellRings& cells) {
  if (cells.rings.empty() || !system::are_offsets(cells.cells, cells.rings.size() - 1) ||
      !system::are_offsets(cells.rings, cells.corners.size()) ||
      !std::ranges::all_of(cells.corners, [&](Index p) { return p < cells.points.size(); })) {
    throw InvalidInput("the arrays of the cells do not fit");
  }
}

}  // namespace rondel::arrangement
