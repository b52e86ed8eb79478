// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads variables of netCDF files by the rules of rondel/conventions.h and formats/cf_values.h.
//
// in    an open netCDF file and its variables
// out   numbers and coordinates in degrees, as the conventions mean them
// index dimensions by their position in a variable
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "io/netcdf_reader.h"
#include "rondel/conventions.h"

namespace rondel::formats {

// Return the headers of all variables of the file, in their order, and of one variable.
std::vector<VariableHeader> headers_of(const io::NetcdfReader& file);
VariableHeader header_of(const io::NetcdfReader& file, const io::VariableInFile& variable);

// Returns the values unpacked, with NaN for missing ones. Throws BadValue if they are no numbers.
std::vector<double> meant_numbers(const io::NetcdfReader& file, const io::VariableInFile& variable);

// Throws BadValue for a mesh in the plane, whose longitudes and latitudes mean nothing.
// degrees_of() does so, too.
void require_sphere(const io::NetcdfReader& file);

// The units of a coordinate that has none and is related to no variable with units.
enum class UsualUnits { of_name, degrees, radians };
// Returns coordinates in degrees, with NaN for missing ones. A variable without units has those of
// the first of its relatives that has some; a relative may be null. The first relative is of the
// same kind: if the longitudes of corners are west of Greenwich, so are the centers', but latitudes
// say nothing about that. Throws BadValue for units that are neither degrees nor radians.
std::vector<double> degrees_of(const io::NetcdfReader& file, const io::VariableInFile& variable,
                               UsualUnits usual = UsualUnits::of_name,
                               std::initializer_list<const io::VariableInFile*> relatives = {});

// Returns an array with its dimensions in another order: dimension k of the result is dimension
// order[k] of `shape`.
std::vector<double> transposed(std::span<const std::uint64_t> shape,
                               const std::vector<std::size_t>& order, std::vector<double> values);
// Returns the values with the dimensions in the wanted order; dimensions are given by their numbers
// in the file, and those of one variable differ.
std::vector<double> in_order(const io::VariableInFile& variable,
                             const std::vector<std::size_t>& wanted, std::vector<double> values);

// Returns the variable with only its first time, if the first of several dimensions is one of time
// and the values are the same at all times; else the variable as it is.
io::VariableInFile without_times(const io::NetcdfReader& file, const io::VariableInFile& variable);

// Longitudes and latitudes on the same dimensions, in degrees; missing ones are NaN.
struct PlaceArrays {
  // The dimensions of the longitudes along which places differ, by their numbers in the file.
  std::vector<std::size_t> dimensions;
  // The lengths of these dimensions.
  std::vector<std::uint64_t> shape;
  // Other dimensions, such as time, along which places are repeated.
  std::vector<std::size_t> repeated;
  std::vector<double> lon;
  std::vector<double> lat;
};
// Reads the places. Dimensions along which they only repeat are dropped. Throws BadValue if the
// dimensions of `lon` and `lat` do not agree, or places move with time.
PlaceArrays places_of(const io::NetcdfReader& file, const io::VariableInFile& lon,
                      const io::VariableInFile& lat, UsualUnits usual = UsualUnits::of_name);

}  // namespace rondel::formats
