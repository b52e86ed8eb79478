// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Whether a vertex a lies within an angle of the direction of a query point p, seen from the center
// o of a sphere of radius R.
//
//     projected: p.a >= c |p| |a|          c stands for the cosine of the angle
//     weighted:  p.a >= c |p| R            (the Laguerre distance)
//
// The cosine is c = 1 - t/2 up to 90 degrees and c = -(1 - t/2) beyond, with a double
// t = 4 sin^2(angle/2) (beyond 90 degrees: of the angle that is left to 180 degrees). So small
// angles keep their full precision. For this c the test is exact.
#pragma once

#include "predicates/points.h"
#include "predicates/rung.h"

namespace rondel::predicates {

struct Cosine {
  bool is_positive = true;
  double t = 0;
};

// The t of an angle in radians, the same bits on every platform; relative error at most 8u, and
// below 1e-150 it counts as 0. Precondition: 0 <= angle < pi.
Cosine cosine_of(double angle);

// --- the rungs: positive for inside ---

// |u_p - u_a|^2 <= t, or |u_p + u_a|^2 >= t beyond 90 degrees, of directions within
// `direction_error` of unit vectors.
inline Sign is_within_angle_filter(const Vector& a, const Vector& p, const Cosine& cosine) {
  const Vector d = cosine.is_positive ? p - a : p + a;
  const double d2 = dot(d, d);
  const double value = cosine.is_positive ? cosine.t - d2 : d2 - cosine.t;
  constexpr double bound = within_angle_bound * within_angle_bound;
  return unless_unsure(value, value * value > bound * std::max(d2, cosine.t));
}

// What is_within_angle_filter() asks, from unit vectors within 2^-100 of the exact ones.
Sign is_within_angle_double_double(const exact::SplitPoint& a, const exact::SplitPoint& p,
                                   const Cosine& cosine);

// Never unsure: zero on the boundary.
Sign is_within_angle_exact(const Point& a, const Point& p, const Cosine& cosine,
                           const Point& center);

Sign is_within_power_filter(const Point& a, const Point& p, const Cosine& cosine,
                            const Sphere& sphere);
Sign is_within_power_exact(const Point& a, const Point& p, const Cosine& cosine,
                           const Sphere& sphere);

// --- the ladders: zero on the boundary, which belongs to the inside ---

// Projected.
template <RaySource S>
[[nodiscard]] Decision is_within_angle(S& points, Index a, Index p, const Cosine& cosine) {
  Sign sign = is_within_angle_filter(points.direction(a), points.direction(p), cosine);
  if (sign != Sign::zero) return {sign, Rung::filter};
  sign = is_within_angle_double_double(points.split(a), points.split(p), cosine);
  if (sign != Sign::zero) return {sign, Rung::double_double};
  return {is_within_angle_exact(points.point(a), points.point(p), cosine, points.center()),
          Rung::exact};
}

// Weighted, on a sphere around the center of the points.
template <PointSource S>
[[nodiscard]] Decision is_within_power(S& points, Index a, Index p, const Cosine& cosine,
                                       double squared_radius) {
  const Sphere sphere = {points.center(), squared_radius};
  const Sign sign = is_within_power_filter(points.point(a), points.point(p), cosine, sphere);
  if (sign != Sign::zero) return {sign, Rung::filter};
  return {is_within_power_exact(points.point(a), points.point(p), cosine, sphere), Rung::exact};
}

}  // namespace rondel::predicates
