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

// The values that differ, in the order in which they come, and which of them each one is. 0 and -0 are equal.
template <class Value>
struct Distinct {
  std::vector<Value> values;
  std::vector<Index> numbers;
};
Distinct<LonLat> distinct(std::span<const LonLat> positions);
Distinct<Point> distinct(std::span<const Point> points);

}  // namespace rondel::overlay
