// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Subdivides the lines of regions so that they meet only in common ends: snap rounding (Hobby 1999;
// Guibas, Marimont 1998).
//
// The ends of lines and the positions where lines cross, each rounded to the grid, have hot pixels.
// A line becomes the polyline through the middles of all hot pixels that it meets, in their order
// along the line.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::map {

// A side of a loop in the plane, with the region to the left.
struct DirectedLine {
  LonLat from;
  LonLat to;
  friend bool operator==(const DirectedLine&, const DirectedLine&) = default;
};

// A line, with the number of times that each region has it as a side: the sides from `from` to `to`
// minus those back.
struct NodedLine {
  struct RegionCount {
    std::size_t region;
    int count;
    friend bool operator==(const RegionCount&, const RegionCount&) = default;
  };
  LonLat from;  // before `to`, by longitude, then by latitude
  LonLat to;
  std::vector<RegionCount> counts;  // one count for each region, in ascending order; no count is 0
};

// Returns the sides of all regions, region by region, on the grid of map_grid.h.
//
// 1. Two lines have at most a common end in common.
// 2. A point of a line is at most half a step of the grid, in longitude and in latitude, from a
//    point of a rounded side, which is at most another half step from the given side.
// 3. Sides that bound a region still bound it: as many of them leave each position as reach it.
std::vector<NodedLine> snap_rounded(std::span<const std::vector<DirectedLine>> sides_of_regions);

}  // namespace rondel::map
