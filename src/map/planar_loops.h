// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Loops of positions in the plane of longitude and latitude, and the polygons that they bound; by exact signs.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "map/directed_line.h"
#include "map/region.h"
#include "rondel/types.h"

namespace rondel::map {

using Loop = std::vector<LonLat>;  // closed, without repeating the first position at the end

// Twice the area, positive if the loop is counterclockwise; square degrees, rounded.
double doubled_loop_area(std::span<const LonLat> loop);

// Whether a position is in the loops twice.
bool has_touching(std::span<const Loop> loops);

// Takes out the sides that are there in both directions; the others keep their order.
void cancel_opposite(std::vector<DirectedLine>& lines);

// Two sides next to each other around a position: where regions do not overlap themselves, those that leave it and those
// that reach it take turns. `is_paired` if they do.
struct SideWedge {
  LonLat at;
  LonLat first;
  LonLat second;
  bool is_paired;
};
// All of the positions where they do not.
std::vector<SideWedge> unpaired_sides(std::span<const DirectedLine> lines);

// The simple loops of sides that have no unpaired ones: each keeps to one fan of the region, so that two parts of it
// that touch in a position only have no loop in common.
std::vector<Loop> traced_loops(std::span<const DirectedLine> lines);

// Polygons, or the loops that lie wrong: a clockwise one in no other, a counterclockwise one inside the region.
struct PolygonsOfLoops {
  std::vector<PolygonWithHoles> polygons;
  std::vector<Loop> misplaced;
};

// The polygons of simple loops that meet in positions of both only, in the order of their outer loops; rings are closed.
PolygonsOfLoops polygons_of_loops(std::vector<Loop> loops);

}  // namespace rondel::map
