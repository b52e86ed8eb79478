// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which loops of the plane lie in which; by exact signs.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::map {

inline constexpr std::size_t misplaced = std::numeric_limits<std::size_t>::max();

// The first `num_outer` of the loops are counterclockwise, the others clockwise. A clockwise one belongs to the
// smallest counterclockwise one around it, if it lies once more in counterclockwise loops than in clockwise ones; a
// counterclockwise one to itself, if it lies in as many of both. Others are misplaced.
// Precondition: the loops are simple, and meet in positions of both only.
std::vector<std::size_t> owners_of(std::span<const std::vector<LonLat>> loops,
                                   std::size_t num_outer);

}  // namespace rondel::map
