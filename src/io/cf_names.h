// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The names by which CF and models know longitudes, latitudes and their bounds.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "rondel/conventions.h"
#include "rondel/export.h"

namespace rondel::io {

// Makes ASCII letters small; others stay.
RONDEL_API std::string lower_case(std::string_view text);
RONDEL_API std::string_view without_blanks(std::string_view text);

enum class CoordinateKind { lon, lat };

// Whether models give longitudes, or latitudes, of places this name: the fallback where no attribute says it.
bool is_known_name(std::string_view name, CoordinateKind kind);
// Whether a variable holds longitudes, or latitudes. 0: no, 1: by its name, 2: by its units, 3: by its standard_name.
RONDEL_API int coordinate_evidence(const VariableHeader& variable, CoordinateKind kind);
// Whether the standard_name says that these are coordinates of a rotated pole or of a map projection, whatever their units are (CF 5.6).
RONDEL_API bool is_rotated_or_projected(const VariableHeader& variable);
// Says so in a sentence without a full stop.
std::string remark_on_rotation(const VariableHeader& variable);
// Whether the names differ only in that one is of longitudes and the other one of latitudes: ULONG and ULAT, glamu and gphiu.
bool are_partners(std::string_view lon, std::string_view lat);
// A sentence for each variable that is called as longitudes or latitudes are, and whose units are no degrees, and for each that is
// rotated or projected; each begins with "; ".
RONDEL_API std::string remark_on_units(std::span<const VariableHeader> variables);
// Whether MPAS or ICON, whose coordinates are radians, has a variable of this name.
bool is_in_radians(std::string_view name);
// Whether a variable of this name in a mesh of MPAS or ICON, or with this cf_role of UGRID, has the numbers of neighbors and corners.
RONDEL_API bool is_connectivity(const VariableHeader& variable);
// Whether models give the dimension of their cells this name.
RONDEL_API bool is_name_of_cells(std::string_view dimension);
// Whether the name is that of bounds of `coordinate`.
bool is_name_of_bounds(std::string_view name, std::string_view coordinate);
// Whether a dimension is called time.
RONDEL_API bool is_name_of_time(std::string_view name);

}  // namespace rondel::io
