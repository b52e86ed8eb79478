// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regions whose lines cross, as unions of the faces into which their lines divide the plane.
#pragma once

#include <span>
#include <vector>

#include "map/planar_loops.h"
#include "map/polygon.h"
#include "map/region.h"

namespace rondel::map {

// The polygons of regions that have these sides.
// 1. They are valid, and no two regions overlap, however the sides cross.
// 2. Where two regions meet, both have the same positions, bit by bit, which are on the grid of map_grid.h.
// 3. Where the sides of each region bound it and cross no others they stay, but for rounding to the grid.
std::vector<std::vector<PolygonWithHoles>> settled_regions(
    std::span<const std::vector<DirectedLine>> sides_of_regions, unsigned threads);

// The same of regions that are convex on the sphere, and have no holes but those of rounding: they get what is in these.
std::vector<std::vector<LonLatPolygon>> settled_convex_regions(
    std::span<const std::vector<DirectedLine>> sides_of_regions, unsigned threads);

std::vector<DirectedLine> sides_of_loops(std::span<const Loop> loops);

}  // namespace rondel::map
