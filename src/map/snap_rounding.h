// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Lines of regions that meet in common ends only: snap rounding (Hobby 1999; Guibas, Marimont 1998).
//
// Ends of lines and the positions where lines cross, each rounded to the grid, have hot pixels. A line becomes the polyline
// through the middles of all hot pixels that it meets, in their order along it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "map/directed_line.h"
#include "rondel/types.h"

namespace rondel::map {

// A line and how often each region has it: as a side that leads from `from` to `to` so many times more than back.
struct NodedLine {
  struct RegionCount {
    std::size_t region;
    int count;
    friend bool operator==(const RegionCount&, const RegionCount&) = default;
  };
  LonLat from;  // before `to`, by longitude, then by latitude
  LonLat to;
  std::vector<RegionCount> counts;  // by region, none of them 0
};

// The sides of all regions, region by region, on the grid of map_grid.h.
// 1. Two lines have at most an end of both in common.
// 2. A point of a line is at most half a step of the grid, in longitude and in latitude, from a point of a side, and another
//    half of one from the side as it was given.
// 3. The sides of a region that was bounded by closed loops still bound it: as many leave each position as reach it.
std::vector<NodedLine> snap_rounded(std::span<const std::vector<DirectedLine>> sides_of_regions);

}  // namespace rondel::map
