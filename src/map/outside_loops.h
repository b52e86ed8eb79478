// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the part of the map that no region covers.
#pragma once

#include <span>
#include <vector>

#include "map/planar_loops.h"

namespace rondel::map {

// Returns loops with the uncovered part to their left: the border of the map and the sides of all
// regions reversed, without sides that occur in both directions. The result is empty where regions
// cover the map.
std::vector<Loop> outside_loops(std::span<const std::vector<Loop>> regions);

}  // namespace rondel::map
