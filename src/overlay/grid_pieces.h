// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the intersections of cells with the cells of a grid of meridians and parallels.
//
// in    cells of any shape, or another grid
// out   PieceRows: areas and first moments
// index rows: indices of the cells in the input; columns: cells of the grid
#pragma once

#include "overlay/cell_set_data.h"
#include "overlay/pieces.h"
#include "overlay/prepared_grid.h"

namespace rondel::overlay {

// Returns the pieces of all cells. Throws InvalidInput if the pieces of a cell do not add up to it
// (require_sum()).
PieceRows pieces(const CellSetData& cells, const PreparedGrid& grid, bool has_moments,
                 const Execution& execution);

// Returns the pieces of the cells of one grid in the cells of another.
PieceRows pieces(const PreparedGrid& rows, const PreparedGrid& columns, bool has_moments);

}  // namespace rondel::overlay
