// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sides that are straight in longitude and latitude as arcs of great circles.
#pragma once

#include <span>
#include <vector>

#include "overlay/plane_sweep.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The positions of a straight line so near to each other that arcs between them are within the tolerance (radians) of
// it: the first one, and those between, without the last one. The same both ways.
void append_divided(const LonLat& from, const LonLat& to, double tolerance,
                    std::vector<LonLat>& positions);

// Sides divided further, until arcs lie to each other as the straight lines do (docs/theory/polygons.md): where one comes
// nearer to a corner than its arc may be from it, it gets a corner on that meridian.
struct DividedSides {
  std::vector<LonLat> positions;
  std::vector<std::uint64_t> offsets = {0};  // of each side; its positions, without the last one
};
DividedSides divide_sides(std::span<const PlaneSide> sides, double tolerance, unsigned threads);

}  // namespace rondel::overlay
