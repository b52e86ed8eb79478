// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Distances as numbers, for reports; queries compare exactly instead.
#pragma once

#include "rondel/types.h"

namespace rondel::query {

// The angle between the rays of two points, to a few ulp at any size.
double angle_between(const Point& p, const Point& q, const Point& center);

// The Laguerre distance of p from a weighted site, arccos of (u.(site-o))/R clamped to [-1, 1]; u
// is the unit vector of p. The versine (1 minus this quotient) is off by less than 1e-15 at
// distances up to 180 degrees from a real circle, and for a point near the sphere by less than
// 1e-15 relatively.
double laguerre_distance(const Point& p, const Point& site, const Sphere& sphere);

}  // namespace rondel::query
