// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The inputs of the measurements, the same bits for every program.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "rondel/types.h"

namespace rondel::bench {

// Kinds: uniform, fibonacci, grid (500 x 1000 for n = 500,000), patch (n sites in a 1e-6 rad
// patch and 1,000 global ones), paper-s; for hulls ball, cube, gaussian; for weights circles (radii
// up to 30 degrees), small-circles (up to 0.3) and mixed-weights (places, and one site at 1e15).
// A name that ends in .csv or .npy is a file, of which all sites are read.
// Throws std::invalid_argument for others.
std::vector<Point> make_input(const std::string& kind, std::size_t n);

}  // namespace rondel::bench
