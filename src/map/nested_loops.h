// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Determines which loops of the plane lie inside of which, by exact signs.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::map {

inline constexpr std::size_t misplaced = std::numeric_limits<std::size_t>::max();

// Returns the index of the counterclockwise loop that each loop belongs to, or `misplaced`.
//
// The first `num_outer` loops are counterclockwise, the others clockwise. A clockwise loop belongs
// to the smallest counterclockwise loop around it, if it lies in one counterclockwise loop more
// than in clockwise ones. A counterclockwise loop belongs to itself, if it lies in as many
// counterclockwise loops as clockwise ones. Other loops are misplaced. Precondition: the loops are
// simple, and two loops meet only in positions that both have.
std::vector<std::size_t> owners_of(std::span<const std::vector<LonLat>> loops,
                                   std::size_t num_outer);

}  // namespace rondel::map
