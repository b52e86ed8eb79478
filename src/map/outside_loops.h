// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What of the map no region covers.
#pragma once

#include <span>
#include <vector>

#include "map/planar_loops.h"

namespace rondel::map {

// Loops with that to the left: the border of the map, and the sides of all regions turned around, without what is there in
// both directions. Where regions cover the map there are none.
std::vector<Loop> outside_loops(std::span<const std::vector<Loop>> regions);

}  // namespace rondel::map
