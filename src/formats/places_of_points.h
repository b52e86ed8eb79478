// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points as a side of a regridding: tables, arrays of positions, and the points of GeoJSON and of the
// files that GDAL reads; and what files of fields say about such places by CF (chapter 9, discrete
// sampling geometries).
//
// in    a file of points; the fields at its points
// out   places with the columns beside them; attributes of CF
// index points, in the order of the file
#pragma once

#include <string>
#include <vector>

#include "rondel/fields.h"
#include "rondel/io.h"
#include "rondel/types.h"
#include "rondel/weight_files.h"

namespace rondel::formats {

struct PlacesOfPoints {
  std::vector<LonLat> places;
  std::vector<Column> columns;       // all columns or properties that are no coordinates
  std::vector<std::string> remarks;  // on rows without a place
};

// True if points are read from files of this format. Those of GeoJSON and GDAL may have polygons.
bool may_have_points(const FileName& file);

// Reads the points of a file. Throws FileError; for polygons, it says which methods take them.
PlacesOfPoints read_places_of_points(const FileName& file, const Execution& execution);

// Throws FileError that says which methods value points, if the file has points and no polygons.
void refuse_points_as_cells(const FileName& file, const Execution& execution);

// Adds the attribute `featureType` to fields at sites. Where it names a series or a profile, the first
// texts of the side of which each names one site get the `cf_role` of its name. Fields with other
// dimensions than times and levels, or of several such types, get neither. Returns a remark if a column
// loses its role because its cells do not name one site each; or an empty text.
std::string describe_features(FieldSet& fields, WeightSide& side);

}  // namespace rondel::formats
