// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads bounds of coordinates, which files that were joined repeat along time or other dimensions.
//
// in    an open netCDF file, a coordinate and its bounds
// out   the bounds of each cell once, in degrees
#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

#include "formats/cf_reader.h"
#include "io/netcdf_reader.h"

namespace rondel::formats {

// Bounds in degrees, without the dimensions along which they repeat.
struct BoundsArray {
  io::VariableInFile variable;  // with the dimensions, lengths and number of values that are left
  std::vector<double> values;
};

// Reads bounds. `places` says along which dimensions of the coordinate places differ, and along
// which they repeat; of an axis these are its own one and none. `relatives` give the units, as for
// degrees_of(). Throws BadValue if cells change along a dimension that counts none.
BoundsArray read_bounds(const io::NetcdfReader& file, const io::VariableInFile& bounds,
                        const PlaceArrays& places,
                        std::initializer_list<const io::VariableInFile*> relatives);

}  // namespace rondel::formats
