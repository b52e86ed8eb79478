// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The exact projection of a point on the unit sphere, to twice double precision.
#pragma once

#include <cmath>
#include <span>

#include "exact/eft.h"
#include "exact/vector.h"
#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::exact {

// The unevaluated sum hi + lo.
struct SplitPoint {
  Point hi;
  Point lo;
};

// The unit vector u = (p - center) / |p - center|.
// 1. hi is within 0.51 ulp of u in each coordinate, so |hi - u| <= 2^-53; within 2^-1073 where the
//    coordinate is below 2^-1010.
// 2. |hi + lo - u| <= 2^-100.
// 3. The result does not depend on the platform.
// Precondition: finite coordinates, p != center.
RONDEL_API SplitPoint unit_vector(const Point& p, const Point& center);

// The squared distance of two unit vectors in double-double:
// |u-v|^2 of unit vectors known to 2^-100: off by at most 2^-97 |u-v| (docs/theory/filters.md).
inline DoubleDouble squared_chord(const SplitPoint& u, const SplitPoint& v) {
  const Vector3<DoubleDouble> d = {DoubleDouble{u.hi.x, u.lo.x} - DoubleDouble{v.hi.x, v.lo.x},
                                   DoubleDouble{u.hi.y, u.lo.y} - DoubleDouble{v.hi.y, v.lo.y},
                                   DoubleDouble{u.hi.z, u.lo.z} - DoubleDouble{v.hi.z, v.lo.z}};
  return dot(d, d);
}

// --- its parts, for loops that become vector code ---

// The square of a + its low part, to a relative 2^-103 unless it underflows.
inline DoubleDouble square(DoubleDouble a) {
  const DoubleDouble s = two_square(a.hi);
  return fast_two_sum(s.hi, s.lo + 2 * a.hi * a.lo);
}

inline DoubleDouble squared_norm(const Vector3<DoubleDouble>& d) {
  return square(d.x) + square(d.y) + square(d.z);
}

// Squares for which nothing overflows, nor underflows where it matters.
inline bool is_moderate(double square) { return square > 0x1p-300 && square < 0x1p300; }

// d / |d|, given the square of a moderate length. With y = 1 / |d| rounded and e = 1 - y^2 |d|^2,
// which is some 5u at most, 1 / |d| = y (1 + e/2 + 3/8 e^2) to 40 u^3, a Newton step of higher
// order (docs/theory/filters.md counts the roundings).
inline SplitPoint scaled_to_unit(const Vector3<DoubleDouble>& d, const DoubleDouble& square) {
  const double y = 1 / std::sqrt(square.hi);
  const DoubleDouble y2 = two_square(y);
  const DoubleDouble one = two_product(square.hi, y2.hi);
  const double e = ((1 - one.hi) - one.lo) - (square.hi * y2.lo + square.lo * y2.hi);
  const double correction = e * (0.5 + 0.375 * e);
  const auto scaled = [y, correction](const DoubleDouble& a) {
    const DoubleDouble p = two_product(a.hi, y);
    return fast_two_sum(p.hi, p.lo + (p.hi * correction + a.lo * y));
  };
  const DoubleDouble ux = scaled(d.x);
  const DoubleDouble uy = scaled(d.y);
  const DoubleDouble uz = scaled(d.z);
  return {{ux.hi, uy.hi, uz.hi}, {ux.lo, uy.lo, uz.lo}};
}

// Exact projections on the unit sphere, of many sites at once: in loops that become vector code,
// where each takes a quarter of the time of exact::unit_vector().
// result[k] = the unit vector from the center to sites[order[k]], with the properties of
// exact::unit_vector().
RONDEL_API void unit_vectors(std::span<const Point> sites, std::span<const Index> order,
                             const Point& center, exact::SplitPoint* result);

}  // namespace rondel::exact
