// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a file of netCDF says of places that are a list, beside their longitudes and latitudes: names of
// stations, the times of a track, heights.
//
// in    a file of netCDF, whose places are targets
// out   columns beside the values at these places
// index places, in the order of the file
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "rondel/io.h"

namespace rondel::formats {

struct DescribedPlaces {
  std::vector<Column> columns;  // with those attributes that hold wherever they stand
  std::string remark;           // names what is left out, as it is no column; or empty
  bool are_sites = false;       // whether the file says by `featureType` that its places are sites
};

// Returns what a file has for a list of so many places. There is nothing for a named grid, for places on
// a grid along axes, and for files that are no netCDF or may be read once only.
//
// 1. Columns are texts, the axis of the dimension of the places, numbers with a `cf_role`, and numbers
//    along this dimension that an attribute `coordinates` lists; of sites all numbers along it.
// 2. Columns have the rows of the places that have a longitude and a latitude.
// 3. Texts that are not UTF-8 or have several dimensions, the name of a whole track, and what describes
//    sites of two dimensions are left out, with a remark.
DescribedPlaces described_places(const FileName& target, std::size_t num_places);

}  // namespace rondel::formats
