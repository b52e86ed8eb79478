// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Exact signs of determinants of steps between points, in integers of the machine: where the
// coordinates of the points are so alike in size that, axis by axis, they all are multiples of one
// power of two below 2^60 times that. Points of a mesh mostly are. Empty where they are not, or
// where the compiler has no integers of 128 bits.
#pragma once

#include <array>
#include <optional>

#include "rondel/types.h"

namespace rondel::exact {

// Returns the sign of det(a-o, b-o, c-o), or nothing if integers do not suffice.
std::optional<Sign> sign_of_volume_in_integers(const Point& o, const Point& a, const Point& b,
                                               const Point& c);

// The side of a circle on the sphere, in integers of the machine: where each ray is one of integers
// below 2^61. It knows all ties among such rays, those of great circles, and of circles whose
// points are of different lengths, too.
// The sign of the determinant of the unit vectors along the rays from the center to b, c, d and p,
// with a last column of ones. Empty where that is not found so: then it is not zero, or some ray is
// none of such integers, or the compiler has none of 128 bits.
std::optional<Sign> side_of_rays_in_integers(const std::array<Point, 4>& points,
                                             const Point& center);

}  // namespace rondel::exact
