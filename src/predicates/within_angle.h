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

#include "predicates/filtered.h"
#include "predicates/tally.h"

namespace rondel::predicates {

struct Cosine {
  bool is_positive = true;
  double t = 0;
};

// The t of an angle in radians, the same bits on every platform; relative error at most 8u, and
// below 1e-150 it counts as 0. Precondition: 0 <= angle < pi.
Cosine cosine_of(double angle);

// |u_p - u_a|^2 <= t, or |u_p + u_a|^2 >= t beyond 90 degrees, from stored directions: positive for
// yes, zero for unsure.
inline Sign is_within_angle_filter(const Vector& a, const Vector& p, const Cosine& cosine) {
  const Vector d = cosine.is_positive ? p - a : p + a;
  const double d2 = dot(d, d);
  const double value = cosine.is_positive ? cosine.t - d2 : d2 - cosine.t;
  constexpr double bound = within_angle_bound * within_angle_bound;
  return unless_unsure(value, value * value > bound * std::max(d2, cosine.t));
}

// The rungs above the filter; zero means on the boundary, which belongs to the inside.
Decision is_within_angle_ladder(const Point& a, const Point& p, const Cosine& cosine,
                                const Point& center);

// The whole ladder of the weighted model.
Decision is_within_power_ladder(const Point& a, const Point& p, const Cosine& cosine,
                                const Sphere& sphere);

}  // namespace rondel::predicates
