// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Distances as numbers, for reports; queries compare exactly instead.
#pragma once

#include "rondel/types.h"

namespace rondel::query {

// The angle between the rays of two points, within 8e-16 of itself and 1e-29.
double angle_between(const Point& p, const Point& q, const Point& center);

// The Laguerre distance of p from a weighted site, arccos of (u.(site-o))/R clamped to [-1, 1]; u
// is the unit vector of p. The quotient is off by less than 1e-15 (1 + |site-o|/R).
double laguerre_distance(const Point& p, const Point& site, const Sphere& sphere);

}  // namespace rondel::query
