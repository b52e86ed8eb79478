// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Merges points that a map cannot tell apart, for all regions that have them.
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::map {

// Returns a point for each unit vector, in order: the vector itself, snapped() to the poles and the
// antimeridian, or an earlier point that was kept and is within merge_distance of it. Points that
// are kept are farther than that from each other. So a region that is too small for the map does
// not drop a corner that its neighbors keep.
std::vector<Point> merged_points(std::span<const Point> points);

}  // namespace rondel::map
