// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which of two vertices a, b is nearer to the direction of a query point p, seen from the center o.
//
//     projected: the smaller angle, which is the larger u_p.u_a with unit vectors u:
//                sign( p.a |b| - p.b |a| ), all three points taken from o
//     weighted:  the smaller power distance, which is the larger (p-o).(a-o):
//                sign( (p-o).(a-b) )
//
// 1. Positive: a is nearer. Zero: both are at exactly the same distance.
// 2. Odd under exchange of a and b.
// 3. Unchanged when p moves along its ray; projected also when a or b does.
//
// Rungs, projected: |u_p-u_b|^2 - |u_p-u_a|^2 in doubles, whose error is of order u H against
// values of order H^2 at any distance H; the same in double-double; the sign of two terms with
// square roots in balls of more and more words. Rungs, weighted: doubles, balls.
#pragma once

#include <algorithm>

#include "predicates/filtered.h"
#include "predicates/tally.h"

namespace rondel::predicates {

// From the squared distances of stored directions, each within `direction_error` of its unit
// vector.
inline Sign compare_angle_filter(double a2, double b2) {
  const double value = b2 - a2;
  constexpr double bound = angle_bound * angle_bound;
  return unless_unsure(value, value * value > bound * std::max(a2, b2));
}

// The rungs above the filter.
Decision compare_angle_ladder(const Point& a, const Point& b, const Point& p, const Point& center);

// `ray` is p - o.
inline Sign compare_power_filter(const Vector& a, const Vector& b, const Vector& ray) {
  const Vector ba = a - b;
  const double x = ray.x * ba.x;
  const double y = ray.y * ba.y;
  const double z = ray.z * ba.z;
  const double size = std::abs(x) + std::abs(y) + std::abs(z);
  const double value = x + y + z;
  return unless_unsure(value, size > least_product && std::abs(value) > power_bound * size);
}

// The rungs above the filter.
Decision compare_power_ladder(const Point& a, const Point& b, const Point& p, const Point& center);

}  // namespace rondel::predicates
