// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Constraints that do not cross, for Rondel and its peers.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "rondel/types.h"

namespace rondel::bench {

// Joins random sites in squares of the cube around the sphere, up to four pairs in each, about
// `wanted` pairs in all, of which none cross. The sites are in random order, so that those that
// follow each other in a square are random ones.
std::vector<std::array<Index, 2>> random_constraints(const std::vector<Point>& sites,
                                                     std::size_t wanted);

}  // namespace rondel::bench
