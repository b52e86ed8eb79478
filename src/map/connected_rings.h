// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which rings are around the same part of a region.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::map {

// The rings of each connected part of the region to the left of all of them: those that lie in no other one's
// smaller side first, then in the order of the rings that are around the others.
// 1. A ring is around a part if the region is on its smaller side.
// 2. Any other one is a hole: of the smallest part that it is inside of, or of the one that is around all
//    parts.
// Precondition: the rings are simple and meet at most in points.
std::vector<std::vector<std::size_t>> connected_rings(
    std::span<const std::span<const Point>> rings);

}  // namespace rondel::map
