// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the places where a ring that is simple on the sphere crosses itself when it is drawn in the
// plane.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "map/trace.h"

namespace rondel::map {

// Returns all pairs of lines of a trace that meet without being neighbors. A line is named by its
// first point. Nearly parallel arcs that are densified at different places have such lines. The
// time is O(n log n) plus the number of pairs of lines whose rectangles overlap.
std::vector<std::pair<std::size_t, std::size_t>> crossing_lines(const Trace& trace);

// True if two lines of a closed loop of distinct positions meet without being neighbors. The time
// is O(n^2).
bool has_crossing_lines(std::span<const LonLat> loop);

}  // namespace rondel::map
