// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points that a map cannot tell apart become one, for all regions that have them.
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::map {

// Returns a point for each unit vector, in order: the vector itself, snapped(), so that poles and what is on the antimeridian
// stay there, or an earlier one that is kept and within merge_distance of it. Points that are kept are farther apart. So no
// region leaves out a corner, or itself, as it is too small for the map, while its neighbors keep the corners around it.
std::vector<Point> merged_points(std::span<const Point> points);

}  // namespace rondel::map
