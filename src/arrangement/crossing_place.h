// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The place where two arcs cross, rounded.
#pragma once

#include <span>

#include "rondel/types.h"

namespace rondel::arrangement {

// The arcs ab and cd. Precondition: they cross in the inside of both.
struct CrossingEnds {
  Point a;
  Point b;
  Point c;
  Point d;
};

// Returns the unit vector to the place where the arcs ab and cd cross, each coordinate rounded to
// the nearest double, and to 0 below 2^-150. (Where the two nearest doubles differ in their distance by less than a
// millionth of their own distance, either may be the result.) So all pairs of arcs that cross in one point get the same result, and it is
// off by at most sqrt(3) 2^-54. Precondition: the arcs cross in the inside of both.
Point crossing_place(const Point& a, const Point& b, const Point& c, const Point& d);

// Computes the same for each crossing, faster.
void crossing_places(std::span<const CrossingEnds> crossings, std::span<Point> places);

}  // namespace rondel::arrangement
