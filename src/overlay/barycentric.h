// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Barycentric coordinates in polygons on the sphere.
//
// in    the corners of a cell, a place in it
// out   a weight for each corner; their sum is 1, and the weighted sum of the corners points to the
//       place
// index points; corners in their order around the cell
//
// Notation: u is the place, x_i are the corners, p_i = x_i - u without its part along u, s_i the
// length of p_i: the sine of the angle from u to x_i. A_i = det(u, p_i, p_i+1) is positive if u is to
// the left of side i, from x_i to x_i+1.
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel {

struct CornerWeight {
  Index corner;
  double weight;
};

// True if the path a, b, c turns to the left at b by an angle whose sine is above `least_turn`. A
// corner that turns less makes Wachspress's weight of it rise from near 0 to 1 within a like
// fraction of its sides, where mean value coordinates know no such peaks.
inline constexpr double least_turn = 0x1p-10;
bool is_sharp(const Point& a, const Point& b, const Point& c);

// Reverses a ring that is clockwise seen from outside.
void turn_left(std::span<const Point> points, std::vector<Index>& ring);

// Each of these sets the weights of a row whose corners are given. They return false if the weights
// have no positive sum.
// Sets those of the two ends of a side, for a place on it.
bool weigh_side(std::span<const Point> points, const Point& u, std::vector<CornerWeight>& row);
// Sets Wachspress's, for a place inside of a convex cell.
bool weigh_convex(std::span<const Point> points, const Point& u, std::vector<CornerWeight>& row);
// Sets mean value coordinates, for a place inside of any cell.
bool weigh_any(std::span<const Point> points, const Point& u, std::vector<CornerWeight>& row);

}  // namespace rondel
