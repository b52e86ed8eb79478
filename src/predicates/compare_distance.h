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
#pragma once

#include <algorithm>

#include "predicates/points.h"
#include "predicates/rung.h"

namespace rondel::predicates {

// --- the rungs ---

// |u_p-u_b|^2 - |u_p-u_a|^2, whose error is of order u H against values of order H^2 at any distance
// H. From the squared distances of directions, each within `direction_error` of its unit vector.
inline Sign compare_angle_filter(double a2, double b2) {
  const double value = b2 - a2;
  constexpr double bound = angle_bound * angle_bound;
  return unless_unsure(value, value * value > bound * std::max(a2, b2));
}

// |u_p-u_b|^2 - |u_p-u_a|^2 from unit vectors within 2^-100 of the exact ones.
Sign compare_angle_double_double(const exact::SplitPoint& a, const exact::SplitPoint& b,
                                 const exact::SplitPoint& p);

// Two terms with square roots, in balls of more and more words.
Sign compare_angle_exact(const Point& a, const Point& b, const Point& p, const Point& center);

// `ray` is p - o.
inline Sign compare_power_filter(const Vector& a, const Vector& b, const Vector& ray) {
  const Vector ba = a - b;
  const double x = ray.x * ba.x;
  const double y = ray.y * ba.y;
  const double z = ray.z * ba.z;
  const double size = std::abs(x) + std::abs(y) + std::abs(z);
  const double value = x + y + z;
  return unless_unsure(value, size > min_product && std::abs(value) > power_bound * size);
}

// In balls.
Sign compare_power_exact(const Point& a, const Point& b, const Point& p, const Point& center);

// --- the ladders ---

// Projected. `a2` and `b2` are the squared distances of the directions of a and b from that of p,
// which a search has at hand.
template <RaySource S>
[[nodiscard]] Decision compare_angle(S& points, Index a, double a2, Index b, double b2, Index p) {
  Sign sign = compare_angle_filter(a2, b2);
  if (sign != Sign::zero) return {sign, Rung::filter};
  sign = compare_angle_double_double(points.split(a), points.split(b), points.split(p));
  if (sign != Sign::zero) return {sign, Rung::double_double};
  return {compare_angle_exact(points.point(a), points.point(b), points.point(p), points.center()),
          Rung::exact};
}

// Weighted.
template <PointSource S>
[[nodiscard]] Decision compare_power(S& points, Index a, Index b, Index p) {
  const Vector ray = to_vector(points.point(p)) - to_vector(points.center());
  const Sign sign =
      compare_power_filter(to_vector(points.point(a)), to_vector(points.point(b)), ray);
  if (sign != Sign::zero) return {sign, Rung::filter};
  return {compare_power_exact(points.point(a), points.point(b), points.point(p), points.center()),
          Rung::exact};
}

}  // namespace rondel::predicates
