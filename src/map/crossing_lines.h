// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Whether a drawn ring crosses itself in the plane, though it does not on the sphere.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "map/trace.h"

namespace rondel::map {

// The pairs of lines of a trace, named by their first points, that meet without being neighbors.
// Two nearly parallel arcs have such lines where they are densified at different places.
// Time: n log n, and the number of lines whose rectangles overlap.
std::vector<std::pair<std::size_t, std::size_t>> crossing_lines(const Trace& trace);

// Whether two lines of a closed loop of these positions, no two of which are equal, meet so. Time: n^2.
bool has_crossing_lines(std::span<const LonLat> loop);

}  // namespace rondel::map
