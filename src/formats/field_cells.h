// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Says in netCDF with fields which cells are around their points: a grid with a name by that, and
// other cells by their bounds.
#pragma once

#include <string>

#include "rondel/fields.h"
#include "rondel/io.h"
#include "rondel/named_grids.h"
#include "rondel/types.h"
#include "rondel/weight_files.h"

namespace rondel::formats {

// Adds the variable by which a file says that points are the pixels of HEALPix, if they are, or the
// attribute that names another grid.
void add_grid(const NamedGrid& grid, FieldSet& fields);

// Adds the bounds of a file's cells to a side that has its points or axes, if the cells are around
// these: they may be nodes or edges of a mesh, and the file may have no cells, or none that are valid.
void find_bounds(const FileName& file, WeightSide& side, const Execution& execution);

}  // namespace rondel::formats
