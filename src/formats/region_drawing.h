// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Draws cells of any form as polygons in longitude and latitude.
//
// in    cells
// out   polygons of each cell, in degrees
// index cells
#pragma once

#include <vector>

#include "map/valid_regions.h"
#include "rondel/cell_rings.h"
#include "rondel/regions.h"
#include "rondel/types.h"

namespace rondel::formats {

// The arguments of drawn_regions().
struct RegionsToDraw {
  const CellRings& cells;
  double tolerance;  // radians
  const Execution& execution;
  CellDrawing drawing = CellDrawing::together;
};

// Returns the polygons of each cell, in degrees, as those of region_polygons().
std::vector<map::PolygonsOfRegion> drawn_regions(const RegionsToDraw& job);

// Throws InvalidInput if the arrays of the rings do not fit together.
void require_rings(const CellRings& cells);

}  // namespace rondel::formats
