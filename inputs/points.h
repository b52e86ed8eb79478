// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Exactly reproducible operations from which inputs are made.
#pragma once

#include <vector>

#include "inputs/kinds.h"
#include "inputs/random.h"
#include "rondel/types.h"

namespace rondel::inputs {

Point operator+(const Point& a, const Point& b);
Point operator-(const Point& a, const Point& b);
Point operator*(double s, const Point& p);
Point cross_product(const Point& a, const Point& b);
Point normalized(const Point& p);

/// A direction and two others that are orthogonal to it and to each other, all up to rounding.
struct Frame {
  Point up, east, north;
};
Frame frame_around(const Point& up);

/// Returns a unit vector at most about `radius` (in radians) away from `pole`.
Point random_near(Random& random, const Point& pole, double radius);
/// Returns p with one coordinate moved to a neighboring double.
Point moved_by_one_ulp(Random& random, Point p);

Input from_positions(std::vector<LonLat> positions);

}  // namespace rondel::inputs
