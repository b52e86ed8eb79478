// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The inputs of the measurements, the same bits for every program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rondel/types.h"

namespace rondel::bench {

// Kinds: those of inputs/kinds.h, with an angle in degrees as in "circles:0.3". A name that ends
// in .csv or .npy is a file, of which all sites are read.
// Throws std::invalid_argument for others.
std::vector<Point> make_input(const std::string& kind, std::size_t n, std::uint64_t seed = 1);

}  // namespace rondel::bench
