// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds equal or nearly equal points.
//
// in    points or positions
// out   for each the index of its representative
// index points or positions, as given
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::overlay {

// Returns for each point the index of its representative: the first earlier point that represents
// itself and is within `distance` of it in each coordinate, or the point itself if there is none.
std::vector<Index> same_nodes(std::span<const Point> points, double distance);

// The different values, in the order in which they first occur, and for each given value the index
// of its equal among them. 0 and -0 are equal.
template <class Value>
struct Distinct {
  std::vector<Value> values;
  std::vector<Index> numbers;
};
Distinct<LonLat> distinct(std::span<const LonLat> positions);
Distinct<Point> distinct(std::span<const Point> points);

}  // namespace rondel::overlay
