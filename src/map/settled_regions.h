// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes valid polygons of regions whose lines cross: each region becomes the union of some of the
// faces into which the lines divide the plane.
#pragma once

#include <span>
#include <vector>

#include "map/planar_loops.h"
#include "map/polygon.h"
#include "map/region.h"

namespace rondel::map {

// Returns the polygons of each region, given its sides.
//
// 1. The polygons are valid, and no two regions overlap, however the sides cross.
// 2. Where two regions meet, both have the same positions, bit by bit, on the grid of map_grid.h.
// 3. If the sides of each region bound it and cross no others, they stay, except for rounding to
//    the grid.
std::vector<std::vector<PolygonWithHoles>> settled_regions(
    std::span<const std::vector<DirectedLine>> sides_of_regions, unsigned threads);

// Returns the same polygons without their holes, for regions that are convex on the sphere: their
// holes come from rounding only, and are filled.
std::vector<std::vector<LonLatPolygon>> settled_convex_regions(
    std::span<const std::vector<DirectedLine>> sides_of_regions, unsigned threads);

// Returns the sides of all loops, in order.
std::vector<DirectedLine> sides_of_loops(std::span<const Loop> loops);

}  // namespace rondel::map
