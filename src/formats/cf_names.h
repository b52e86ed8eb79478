// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The names by which CF and models know longitudes, latitudes and their bounds.
//
// in    names and attributes of variables and dimensions
// out   what they mean
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/conventions.h"

namespace rondel::formats {

// Returns the words of a text that spaces separate.
std::vector<std::string> words_of(const std::string& text);

// True for a usual name of a dimension of places: `lon`, `rlat`, `x`, `ncells`, `xi_rho` ...
bool is_dimension_of_places(const std::string& dimension);

// Returns the text with ASCII letters in lower case; other characters are not changed.
std::string lower_case(std::string_view text);
// Returns the text without blanks at both ends.
std::string_view without_blanks(std::string_view text);

// The two kinds of coordinates on a sphere.
enum class CoordinateKind { lon, lat };

// True if models give this name to longitudes, or latitudes, of places. It decides if no attribute
// does.
bool is_known_name(std::string_view name, CoordinateKind kind);
// True if the units are angles and a word of the name begins or ends as longitudes and latitudes do:
// `u_lon`, `geolat_c`, `lonCell`, but not `platform_zenith_angle`. A name that ends with an underscore
// has given way to that of a coordinate, and is none.
bool is_named_like_degrees(const VariableHeader& variable);
// True if models give this name to the true longitudes, or latitudes, of places: a known name, one of
// parts of cells, or MOM's `geolon_t` ...
bool is_name_of_places(std::string_view name, CoordinateKind kind);
// True if MPAS or ICON give this name to longitudes, or latitudes, of vertices or edges.
bool is_name_of_part(std::string_view name, CoordinateKind kind);
// Returns the evidence that a variable holds longitudes, or latitudes: 0 none, 1 its name, 2 its
// units, 3 its standard_name.
int coordinate_evidence(const VariableHeader& variable, CoordinateKind kind);
// True if the standard_name says that these are coordinates of a rotated pole or of a map
// projection, whatever their units are (CF 5.6).
bool is_rotated_or_projected(const VariableHeader& variable);
// Returns a sentence that says so, without a full stop.
std::string remark_on_rotation(const VariableHeader& variable);
// True if the names differ only in that one is of longitudes and the other one of latitudes: ULONG
// and ULAT, glamu and gphiu.
bool are_partners(std::string_view lon, std::string_view lat);
// Returns a sentence for each variable that has a name of longitudes or latitudes and units that
// are no degrees, and for each that is rotated or projected; each begins with "; ".
std::string remark_on_units(std::span<const VariableHeader> variables);
// True if MPAS or ICON, whose coordinates are radians, have a variable of this name.
bool is_in_radians(std::string_view name);
// True if the variable has the name of a list of neighbors or corners in MPAS or ICON, or a cf_role
// of such a list in UGRID.
bool is_connectivity(const VariableHeader& variable);
// True if `name` is a usual name of the bounds of `coordinate`.
bool is_name_of_bounds(std::string_view name, std::string_view coordinate);
// Returns the usual names of the bounds of `coordinate`.
std::vector<std::string> usual_names_of_bounds(std::string_view coordinate);
// Returns the names of the coordinates of which `name` is a usual name of the bounds; they are parts
// of `name`.
std::vector<std::string_view> usual_coordinates_of_bounds(std::string_view name);
// Returns the names of the grids of a file that are not read, for messages: each once, the first three
// by the alphabet.
std::string text_of_others(std::vector<std::string> grids);
}  // namespace rondel::formats
