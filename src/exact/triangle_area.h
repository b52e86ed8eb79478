// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>

#include "exact/argument.h"
#include "exact/vector.h"
#include "rondel/types.h"

namespace rondel::exact {

// The area of the triangle of three unit vectors (Oosterom, Strackee 1983), positive counterclockwise.
inline double triangle_area(const Point& a, const Point& b, const Point& c) {
  const double sine = det(a, b - a, c - a);
  const double half = argument(std::abs(sine), 1 + dot(a, b) + dot(b, c) + dot(c, a));
  return sine < 0 ? -2 * half : 2 * half;
}

}  // namespace rondel::exact
