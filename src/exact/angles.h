// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Angles, longitudes and areas, the same bits on every platform: what C libraries compute differs
// between them, and between processors with and without fused multiply-adds.
#pragma once

#include <cmath>
#include <numbers>

#include "exact/vector.h"
#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::exact {

// The argument of x + iy, from -pi to pi, for finite x and y.
// 1. Within 2.5 ulp of the exact value, as long as that is no subnormal number: just below 1/16, where atan(1/8) and a
//    difference as large are summed; within 1.75 ulp elsewhere.
// 2. Odd in y. With y = 0 it is y if x is not negative (0 of either sign is not), else pi with y's sign.
// Uses only operations that IEEE 754 rounds correctly.
RONDEL_API double argument(double y, double x);

struct SineCosine {
  double sine;
  double cosine;
};

// Returns the sine and the cosine of an angle.
// 1. Within 1 ulp of the exact values (2 ulp for sines of angles below 1e-300, whose products lose digits).
// 2. Multiples of 90 degrees give exactly -1, 0 or 1; zeros are positive.
// 3. Odd (sine) and even (cosine) in the angle; unchanged when the angle grows by 360 degrees.
// Uses only operations that IEEE 754 rounds correctly, and an exact remainder.
RONDEL_API SineCosine sine_cosine_of_degrees(double degrees);

inline constexpr double degrees_per_radian = 180 / std::numbers::pi;

inline bool is_pole(const Point& p) { return p.x == 0 && p.y == 0; }

// Returns the distance from the line through the poles.
inline double distance_from_axis(const Point& p) { return std::sqrt(p.x * p.x + p.y * p.y); }

// Returns the longitude and latitude of a unit vector that is not a pole. A point on the
// antimeridian has two longitudes: it gets 180 if `east` is true, and -180 otherwise.
RONDEL_API LonLat lonlat_of(const Point& p, bool east);

// The area of the triangle of three unit vectors (Oosterom, Strackee 1983), positive counterclockwise.
inline double triangle_area(const Point& a, const Point& b, const Point& c) {
  const double sine = det(a, b - a, c - a);
  const double half = argument(std::abs(sine), 1 + dot(a, b) + dot(b, c) + dot(c, a));
  return sine < 0 ? -2 * half : 2 * half;
}

}  // namespace rondel::exact
