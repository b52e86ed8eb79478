// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Removes the parts of rings that have no inside.
#pragma once

#include <optional>

#include "overlay/subdivision.h"
#include "rondel/cell_rings.h"

namespace rondel::overlay {

// Returns the cells without sides that cancel (spikes and keyholes) and without rings no wider than
// rounding of their corners. Only cells of Shape::other change. `known` is the subdivision of
// `cells`. Returns nothing if no cell changes. Throws InvalidInput for a cell of which nothing is
// left although a ring of it is wider than rounding.
std::optional<CellRings> tidied(const CellRings& cells, const Subdivision& known);

}  // namespace rondel::overlay
