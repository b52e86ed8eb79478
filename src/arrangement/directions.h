// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Directions from a node, and paths from place to place, by exact orientations.
//
// A direction is that of the shorter arc from the node to another point, which is neither on the ray
// of the node nor opposite to it. A path leads along an arc, infinitesimally to its right, so that
// it meets no nodes between its ends.
#pragma once

#include "rondel/types.h"

namespace rondel::arrangement {

// Returns the part of a turn, counterclockwise, from the direction to `reference` to that to p: 0
// for none, 1 for less than half, 2 for half, 3 for more.
int part_of_turn(const Point& node, const Point& reference, const Point& p);

// Compares two directions by the angle from that to `reference`, counterclockwise. Returns -1 if p
// is before q, 0 if they are the same.
int compare_directions(const Point& node, const Point& reference, const Point& p, const Point& q);

// True if a point on the great circle of ab is in the inside of the arc ab. It must be on the ray of
// neither end.
bool is_between(const Point& a, const Point& b, const Point& p);

// True if the path from p to q crosses the arc ab, which neither p nor q may be on.
bool is_path_crossed(const Point& a, const Point& b, const Point& p, const Point& q);

}  // namespace rondel::arrangement
