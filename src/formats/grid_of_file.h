// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the grid that a netCDF file names: that of regrid's outputs, whose points have no bounds.
//
// in    a file
// out   the name of a grid (rondel/named_grids.h), and which of its cells the file has
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/netcdf_reader.h"
#include "rondel/cell_rings.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "rondel/types.h"

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

// Throws BadValue if a file without longitudes and latitudes names a grid of as many places in its
// attributes, as pixels of HEALPix in another order, and these are others. Some of them are compared.
void require_named_places(const io::NetcdfReader& reader, const PlacesOfGrid& grid);

// The grid on which a file says that its points are.
struct GridOfFile {
  std::string name;  // empty if it says nothing of a grid
  std::vector<Index> numbers =
      {};  // those of its cells that are in the file; empty for all in order
  // The lengths of the dimensions of these cells, empty for one.
  std::vector<std::uint64_t> shape = {};
  std::string list = {};  // the variable with the numbers; of listed_pixels() alone
  // Why attributes of the file that name a grid do not count, for the errors of what is read instead.
  std::string why_not = {};
};

// Returns what read() returns. Its FileError also says why attributes that name a grid do not count.
template <class Read>
auto read_without_grid(const GridOfFile& passed_over, const Read& read) {
  try {
    return read();
  } catch (const FileError& error) {
    if (passed_over.why_not.empty()) throw;
    throw FileError(std::string(error.what()) + "; " + passed_over.why_not);
  }
}

// Returns the pixels of HEALPix whose numbers a variable of the file has, or no name: also where the
// file has other places, and where the numbers are none of pixels.
GridOfFile listed_pixels(const io::NetcdfReader& reader);

// True for standard input and a pipe, whose content can be read once.
bool is_read_once(const FileName& file);

// Returns the grid that netCDF says its points are on: if it has the numbers of pixels, or else the
// dimensions of that grid and no other places; and, with `needs_cells`, if its places are centers of
// some cells and it has no bounds. The name of a variable (FILE.nc:NAME) is ignored. Throws FileError
// for a file that cannot be read, names a grid that is none, or has neither longitudes and latitudes
// nor the pixels of which its grid mapping speaks.
GridOfFile grid_of_file(const FileName& file, bool needs_cells);

}  // namespace rondel::formats
