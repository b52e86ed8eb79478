// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds dimensions of variables by their lengths, where no coordinates say which are those of
// points.
//
// in    the lengths of a grid, and a variable
// out   positions of dimensions in the variable
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/field_layout.h"
#include "io/netcdf_reader.h"

namespace rondel::formats {

// Reverses the points' dimensions where the lengths of the grid are theirs in reverse; returns
// false if they are others.
bool fit_lengths(std::span<const std::uint64_t> wanted, const io::NetcdfReader::Variable& variable,
                 std::vector<std::size_t>& points);
// Makes the dimensions that are not those of the points the leading ones.
void take_other_dimensions(const io::NetcdfReader::Variable& variable, FieldDimensions& layout);

}  // namespace rondel::formats
