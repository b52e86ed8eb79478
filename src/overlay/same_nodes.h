// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds nearly equal points.
//
// in    points
// out   for each the index of its representative
// index points, as given
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::overlay {

// Returns for each point the index of its representative: the first earlier point that represents
// itself and is within `distance` of it in each coordinate, or the point itself if there is none.
std::vector<Index> same_nodes(std::span<const Point> points, double distance);

}  // namespace rondel::overlay
