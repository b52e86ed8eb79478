// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// 64-bit integers of netCDF as doubles. Those that are no doubles are compared exactly with the attributes that say what is missing:
// _FillValue, missing_value, valid_min, valid_max, valid_range of the same type, and the fill that netCDF writes. ValueRules compares
// those that are doubles.
#pragma once

#include <cstdint>
#include <span>

#include "io/netcdf_format.h"

namespace rondel::io {

// Whether the type has integers that are no doubles.
inline bool is_wide(NetcdfType type) {
  return type == NetcdfType::int64 || type == NetcdfType::uint64;
}

// Whether the number of 64 bits is a double.
bool is_double(std::int64_t bits, NetcdfType type);

// The least double that is not below the bound, or, of an upper one, the largest that is not above it.
double bound_as_double(std::int64_t bits, NetcdfType type, bool is_lower);

// The integers of a variable, those of uint64 as bits, as doubles; NaN where one is missing and no double. Throws BadValue for others
// that are no doubles; if `may_round` they are rounded.
void to_doubles(const NetcdfVariable& variable, std::span<const std::int64_t> integers,
                std::span<double> out, bool may_round = false);

}  // namespace rondel::io
