// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the grid that a netCDF file names: that of regrid's outputs, whose points have no bounds.
//
// in    a file
// out   the name of a grid (rondel/named_grids.h)
#pragma once

#include <string>

#include "rondel/io.h"

namespace rondel::formats {

// Returns the name of the grid that netCDF says its points are on, if it has the dimensions of that
// grid; an empty text for other files. The name of a variable (FILE.nc:NAME) is ignored. Throws
// FileError for a file that cannot be read, or names a grid that is none.
std::string grid_named_by_file(const FileName& file);

}  // namespace rondel::formats
