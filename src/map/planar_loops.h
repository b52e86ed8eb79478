// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Loops of positions in the plane of longitude and latitude, and the polygons that they bound. All
// decisions use exact signs.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "map/region.h"
#include "map/snap_rounding.h"
#include "rondel/types.h"

namespace rondel::map {

using Loop = std::vector<LonLat>;  // closed, without repeating the first position at the end

// Returns twice the area of a loop in square degrees (rounded), positive if the loop is
// counterclockwise.
double doubled_loop_area(std::span<const LonLat> loop);

// True if a position occurs twice in the loops.
bool has_touching(std::span<const Loop> loops);

// Removes the sides that occur in both directions; the others keep their order.
void cancel_opposite(std::vector<DirectedLine>& lines);

// Two sides that are neighbors around the position `at`, which they share. Around a position of
// regions that do not overlap themselves, sides that leave it and sides that reach it alternate.
// `is_paired` is true if these two do.
struct SideWedge {
  LonLat at;
  LonLat first;
  LonLat second;
  bool is_paired;
};
// Returns the wedges of all positions around which leaving and reaching sides do not alternate.
std::vector<SideWedge> unpaired_sides(std::span<const DirectedLine> lines);

// Returns the simple loops that the sides form. Two parts of the region that touch only in a
// position share no loop. Precondition: unpaired_sides() finds none.
std::vector<Loop> traced_loops(std::span<const DirectedLine> lines);

// Polygons, and the loops that are misplaced: a clockwise loop in no other loop, or a
// counterclockwise loop inside of the region.
struct PolygonsOfLoops {
  std::vector<PolygonWithHoles> polygons;
  std::vector<Loop> misplaced;
};

// Returns the polygons of loops, in the order of their outer loops, with closed rings.
// Precondition: the loops are simple, and two loops meet only in positions that both have.
PolygonsOfLoops polygons_of_loops(std::vector<Loop> loops, unsigned threads = 1);

// Returns loops with the part of the map that no region covers to their left: the border of the map
// and the sides of all regions reversed, without sides that occur in both directions. The result is
// empty where regions cover the map.
std::vector<Loop> outside_loops(std::span<const std::vector<Loop>> regions);

inline constexpr std::size_t misplaced = std::numeric_limits<std::size_t>::max();

// Returns the index of the counterclockwise loop that each loop belongs to, or `misplaced`.
//
// The first `num_outer` loops are counterclockwise, the others clockwise. A clockwise loop belongs
// to the smallest counterclockwise loop around it, if it lies in one counterclockwise loop more
// than in clockwise ones. A counterclockwise loop belongs to itself, if it lies in as many
// counterclockwise loops as clockwise ones. Other loops are misplaced. Precondition: the loops are
// simple, and two loops meet only in positions that both have.
std::vector<std::size_t> owners_of(std::span<const std::vector<LonLat>> loops,
                                   std::size_t num_outer, unsigned threads = 1);

}  // namespace rondel::map
