// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Converts 64-bit integers of netCDF to doubles. Integers that are no doubles are compared exactly
// with the attributes that say what is missing: _FillValue, missing_value, valid_min, valid_max,
// valid_range, and the fill that netCDF writes. ValueRules compares those that are
// doubles.
//
// in    integers of a variable, with its attributes
// out   doubles, NaN for integers that are missing and no doubles
// index values of the variable
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "io/netcdf_format.h"

namespace rondel::io {

// True if the type has integers that are no doubles.
inline bool is_wide(NetcdfType type) {
  return type == NetcdfType::int64 || type == NetcdfType::uint64;
}

// True if an integer is a double; `bits` are those of an integer of this type.
bool is_double(std::int64_t bits, NetcdfType type);

// Returns a bound as a double: the least one that is not below a lower bound, or the largest one
// that is not above an upper one.
double bound_as_double(std::int64_t bits, NetcdfType type, bool is_lower);

// Returns the digits of an integer of this type.
std::string text_of(std::int64_t bits, NetcdfType type);

// Sets `out` to the integers of a variable, those of uint64 as bits; NaN where one is missing and
// no double. Others that are no doubles are rounded. Returns the index of the first one of these, or
// the number of integers.
std::size_t round_to_doubles(const NetcdfVariable& variable, std::span<const std::int64_t> integers,
                             std::span<double> out);

// Sets `out` as round_to_doubles() does, and throws BadValue where that rounds.
void to_doubles(const NetcdfVariable& variable, std::span<const std::int64_t> integers,
                std::span<double> out);

}  // namespace rondel::io
