// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Says which rings of a polygon are within others: a lake in its island, an island in its lake.
//
// in    a polygon whose rings touch each other in places at most
// out   a flag for each ring
// index the rings of the polygon, from 0
#pragma once

#include <cstddef>
#include <vector>

#include "rondel/cell_rings.h"

namespace rondel::meshing {

// Returns for each ring of a cell whether it is on the smaller side of a ring that `is_around`.
// Exact. Nothing is within a ring that crosses itself.
std::vector<bool> rings_within(const CellRings& polygons, std::size_t cell,
                               const std::vector<bool>& is_around);

}  // namespace rondel::meshing
