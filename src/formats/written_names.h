// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Names and attributes by which readers of netCDF take what is written for fields, and not for
// coordinates or for parts of a mesh.
//
// in    the names that are wanted, and attributes
// out   the names of the variables
// index fields, in their order
#pragma once

#include <set>
#include <string>
#include <vector>

#include "formats/field_columns.h"
#include "rondel/conventions.h"

namespace rondel::formats {

// Returns a header of a variable at some points with its attributes.
VariableHeader header_with(std::string name, const std::vector<io::NetcdfAttribute>& attributes);

// Removes the attributes that say that a variable holds longitudes, latitudes or numbers of corners:
// values of a field may be longitudes, but no places are there. Their units become degrees.
void remove_marks_of_coordinates(std::vector<io::NetcdfAttribute>& attributes);

// Returns the names of fields beside coordinates called `lon` and `lat`, and takes them. One that is
// taken gets underscores at its end, and so does one by which readers would know a coordinate, its
// bounds or a part of a mesh: `latitude_`, `lon_bnds_`, `verticesOnCell_`.
std::vector<std::string> take_names_of_fields(std::vector<VariableHeader> fields,
                                              std::set<std::string>& taken);

}  // namespace rondel::formats
