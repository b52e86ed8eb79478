// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Variables of netCDF files by the rules of rondel/conventions.h and io/cf_values.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "io/netcdf_reader.h"
#include "rondel/conventions.h"
#include "rondel/export.h"

namespace rondel::io {

// The headers of the variables of the file, in their order.
RONDEL_API std::vector<VariableHeader> headers_of(const NetcdfReader& file);
RONDEL_API VariableHeader header_of(const NetcdfReader& file,
                                    const NetcdfReader::Variable& variable);

// The values as they are meant: unpacked, missing ones NaN. Throws BadValue.
RONDEL_API std::vector<double> meant_numbers(const NetcdfReader& file,
                                             const NetcdfReader::Variable& variable);

// Throws BadValue for a mesh in the plane, whose longitudes and latitudes mean nothing. degrees_of() does so, too.
RONDEL_API void require_sphere(const NetcdfReader& file);

// The units of a coordinate that has none and is related to no variable with units.
enum class UsualUnits { of_name, degrees, radians };
// Coordinates in degrees; missing ones NaN. A variable without units has those of the first of its relatives that has some; null is
// none. The first relative is of the same kind: corners of longitudes are west of Greenwich as the centers are, latitudes
// are not. Throws BadValue for units that are neither degrees nor radians.
RONDEL_API std::vector<double> degrees_of(
    const NetcdfReader& file, const NetcdfReader::Variable& variable,
    UsualUnits usual = UsualUnits::of_name,
    std::initializer_list<const NetcdfReader::Variable*> relatives = {});

// An array with its dimensions in another order: `order` has the place of each among those of `shape`.
RONDEL_API std::vector<double> transposed(std::span<const std::uint64_t> shape,
                                          const std::vector<std::size_t>& order,
                                          std::vector<double> values);
// The same for dimensions that are named by their numbers in the variable, which differ.
RONDEL_API std::vector<double> in_order(const NetcdfReader::Variable& variable,
                                        const std::vector<std::size_t>& wanted,
                                        std::vector<double> values);

// Longitudes and latitudes of the same dimensions, in degrees; missing ones NaN.
struct PlaceArrays {
  std::vector<std::size_t> dimensions;  // those of the longitudes along which places differ
  std::vector<std::uint64_t> shape;
  std::vector<std::size_t> repeated;  // the others: time
  std::vector<double> lon;
  std::vector<double> lat;
};
// Throws BadValue.
RONDEL_API PlaceArrays places_of(const NetcdfReader& file, const NetcdfReader::Variable& lon,
                                 const NetcdfReader::Variable& lat,
                                 UsualUnits usual = UsualUnits::of_name);

}  // namespace rondel::io
