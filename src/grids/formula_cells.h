// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Some cells of a grid, prepared for an overlay.
//
// in    a grid and indices of its cells, ascending
// out   the cells in this order
// index cells: as listed
#pragma once

#include <span>

#include "grids/grid_formula.h"
#include "rondel/cell_set.h"
#include "rondel/types.h"

namespace rondel::grids {

// Returns the rings of cells, in which equal corners are one.
CellRings rings_of(const GridFormula& grid, std::span<const Index> cells, unsigned threads);

// Returns the same as a set.
CellSet cells_of(const GridFormula& grid, std::span<const Index> cells, const Execution& execution);

}  // namespace rondel::grids
