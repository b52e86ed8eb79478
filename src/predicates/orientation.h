// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The orientation of three points seen from the center o of the sphere (the paper, section 4):
// the sign of det(a-o, b-o, c-o) = det(a-o, b-a, c-a).
//
// 1. Positive when a, b, c are counterclockwise seen from outside.
// 2. Odd under exchange of two arguments, even under cyclic shifts.
// 3. Unchanged when a point moves along its ray.
#pragma once

#include "predicates/points.h"
#include "predicates/rung.h"

namespace rondel::predicates {

// Whether det(a, ab, ac) of directions within `direction_error` of unit vectors has the right sign.
inline bool is_direction_orientation_certain(double value, double ab2, double ac2) {
  const double longest = std::max(ab2, ac2);
  constexpr double bound = direction_orientation_bound * direction_orientation_bound;
  return value * value > bound * longest;
}

// Whether det(from_center, ab, ac) of differences of exact data has the right sign.
inline bool is_orientation_certain(double value, const Vector& from_center, const Vector& ab,
                                   const Vector& ac) {
  return is_beyond(value, orientation_bound, dot(from_center, from_center), dot(ab, ab),
                   dot(ac, ac));
}

// For directions within `direction_error` of unit vectors.
inline Sign orientation_filter(const Vector& a, const Vector& b, const Vector& c) {
  const Vector ab = b - a;
  const Vector ac = c - a;
  const double value = det(a, ab, ac);
  return unless_unsure(value, is_direction_orientation_certain(value, dot(ab, ab), dot(ac, ac)));
}

// The filter for points as given, with numbers of 64 bits where the machine has them.
Sign orientation_extended(const Point& a, const Point& b, const Point& c, const Point& center);

// The ladder, for points as given: a filter in doubles, the same with 64 bits, integers where they
// can tell, doubles with their own exponents where magnitudes differ, the filter with vectors of length
// about 1, balls of more and more words.
Decision orientation(const Point& a, const Point& b, const Point& c, const Point& center);

// What the first rung is sure of, or zero: for libraries above, which then ask the public predicate.
inline Sign sure_orientation(const Vector& a, const Vector& b, const Vector& c) {
  return orientation_filter(a, b, c);
}

// The ladder, for points that may have directions: then these have a filter before.
template <PointSource S>
[[nodiscard]] Decision orientation(S& points, Index a, Index b, Index c) {
  if constexpr (S::model == Model::projected) {
    const Sign sign =
        orientation_filter(points.direction(a), points.direction(b), points.direction(c));
    if (sign != Sign::zero) return {sign, Rung::filter};
  }
  return orientation(points.point(a), points.point(b), points.point(c), points.center());
}

}  // namespace rondel::predicates
