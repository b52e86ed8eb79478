// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Boxes of an array's values: some places along each of its dimensions.
#pragma once

#include <cstddef>
#include <span>

#include "io/netcdf_reader.h"
#include "rondel/export.h"

namespace rondel::io {

inline constexpr std::size_t usual_piece = std::size_t{1} << 20U;

// Reads the numbers of a box with its dimensions in another order: `order` has the place of each among those of the variable, and
// the last one changes fastest in `out`. Beside `out` there is room for about `most_of_piece` values only: the box is read in pieces,
// which have whole chunks where the file is divided into chunks. Throws BadValue as NetcdfReader::read_numbers().
// Precondition: the box lies in the variable, and `out` has its size.
RONDEL_API void read_in_order(const NetcdfReader& file, const NetcdfReader::Variable& variable,
                              const NetcdfBox& box, std::span<const std::size_t> order,
                              std::span<double> out, std::size_t most_of_piece = usual_piece);

}  // namespace rondel::io
