// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::overlay {

// For each point the first one before it, or itself, that is as near as `distance` in each coordinate and has no such
// point itself.
std::vector<Index> same_nodes(std::span<const Point> points, double distance);

// The positions that differ in a bit, in the order in which they come, and which of them each one is.
struct DistinctPositions {
  std::vector<LonLat> positions;
  std::vector<Index> numbers;
};
DistinctPositions distinct_positions(std::span<const LonLat> positions);

}  // namespace rondel::overlay
