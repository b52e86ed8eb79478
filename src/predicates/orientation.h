// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The orientation of three points seen from the center o of the sphere (the paper, section 4):
// the sign of det(a-o, b-o, c-o) = det(a-o, b-a, c-a).
//
// 1. Positive when a, b, c are counterclockwise seen from outside.
// 2. Odd under exchange of two arguments, even under cyclic shifts.
// 3. Unchanged when a point moves along its ray.
#pragma once

#include "predicates/filtered.h"
#include "predicates/tally.h"

namespace rondel::predicates {

// For directions within `direction_error` of unit vectors.
inline Sign orientation_filter(const Vector& a, const Vector& b, const Vector& c) {
  const Vector ab = b - a;
  const Vector ac = c - a;
  const double value = det(a, ab, ac);
  const double longest = std::max(dot(ab, ab), dot(ac, ac));
  constexpr double bound = direction_orientation_bound * direction_orientation_bound;
  return unless_unsure(value, value * value > bound * longest);
}

// The whole ladder for exact data.
Decision orientation_ladder(const Point& a, const Point& b, const Point& c, const Point& center);

}  // namespace rondel::predicates
