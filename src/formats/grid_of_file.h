// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the grid that a netCDF file names: that of regrid's outputs, whose points have no bounds.
//
// in    a file
// out   the name of a grid (rondel/named_grids.h)
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "io/netcdf_reader.h"
#include "rondel/cell_rings.h"
#include "rondel/io.h"

namespace rondel::formats {

// The places of a grid.
struct PlacesOfGrid {
  std::uint64_t num_places;
  const LonLatAxes* axes;  // null if it has none
  std::function<LonLat(std::size_t)> place;
};

// True unless a file has longitudes and latitudes of as many places, and these are others. Axes are
// compared as a whole, and of other places some: the first ones, the last ones, and some between
// them.
bool may_be_at(const io::NetcdfReader& reader, const PlacesOfGrid& grid);

// Returns the name of the grid that netCDF says its points are on, if it has the dimensions of that
// grid and no other places, as after it was turned upside down; an empty text for other files. The name of a variable (FILE.nc:NAME) is ignored. Throws
// FileError for a file that cannot be read, or names a grid that is none.
std::string grid_named_by_file(const FileName& file);

}  // namespace rondel::formats
