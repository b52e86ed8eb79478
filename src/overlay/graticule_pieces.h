// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The pieces of cells in the cells of grids of meridians and parallels.
#pragma once

#include "overlay/graticule.h"
#include "overlay/partition_data.h"
#include "overlay/pieces.h"

namespace rondel::overlay {

// Rows are the cells, columns those of the grid.
PieceRows pieces(const PartitionData& cells, const Graticule& grid, bool has_moments,
                 const Execution& execution);

PieceRows pieces(const Graticule& rows, const Graticule& columns, bool has_moments);

}  // namespace rondel::overlay
