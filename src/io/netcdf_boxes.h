// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads boxes of an array's values: an interval of indices along each of its dimensions.
//
// in    a variable and a box of it
// out   numbers
// index dimensions of the variable
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "io/netcdf_reader.h"

namespace rondel::io {

// The number of values that are read at a time.
inline constexpr std::size_t usual_piece = std::size_t{1} << 20U;

// Reads the numbers of a box with its dimensions in another order: order[k] is the dimension of the
// variable that comes at position k, and the last one varies fastest in `out`. The box is read in
// pieces of about `max_per_piece` values, which consist of whole chunks if the file is divided into
// chunks; several threads decompress one each. Throws BadValue like NetcdfReader::read_numbers().
// Precondition: the box lies in the variable, and `out` has its size.
void read_in_order(const NetcdfReader& file, const VariableInFile& variable, const NetcdfBox& box,
                   std::span<const std::size_t> order, std::span<double> out, unsigned threads,
                   std::size_t max_per_piece = usual_piece);

// Reads what NetcdfReader::read_numbers() reads, and throws what it does; several threads decompress
// a chunk each.
void read_run(const NetcdfReader& file, const VariableInFile& variable, std::uint64_t begin,
              std::span<double> out, unsigned threads);

}  // namespace rondel::io
