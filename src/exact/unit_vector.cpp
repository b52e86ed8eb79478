// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "exact/unit_vector.h"

#include <algorithm>
#include <cmath>

namespace rondel::exact {
namespace {

// Times 2^exponent, rounded once: not by the ldexp of all platforms where the result is subnormal.
// What a first half makes subnormal becomes 0 by the second one.
DoubleDouble scale(DoubleDouble a, int exponent) {
  const double first = std::ldexp(1.0, exponent / 2);
  const double second = std::ldexp(1.0, exponent - exponent / 2);
  return {a.hi * first * second, a.lo * first * second};
}

using Difference = Vector3<DoubleDouble>;

// d = p - c, times 2^shift for a shift that puts the largest coordinate near 1.
//
// two_diff is exact also for subnormal results. Only a difference beyond 2^1020 is computed from
// quarters, which may drop bits below 2^-1074; then the largest coordinate is above 2^1018, and
// what is dropped is below its 2^-2000th part.
Difference moderate_difference(Difference d, const Point& p, const Point& c) {
  constexpr double limit = 0x1p1020;
  const auto is_far = [](const DoubleDouble& v) { return !(std::abs(v.hi) < limit); };
  if (is_far(d.x) || is_far(d.y) || is_far(d.z)) {
    const auto quarter = [](const Point& q) { return Point{q.x / 4, q.y / 4, q.z / 4}; };
    d = difference(quarter(p), quarter(c));
  }
  const double size = std::max({std::abs(d.x.hi), std::abs(d.y.hi), std::abs(d.z.hi)});
  if (size == 0) return d;  // a site that was moved to the center by whoever has the memory
  const int shift = -std::ilogb(size);
  return {scale(d.x, shift), scale(d.y, shift), scale(d.z, shift)};
}

}  // namespace

SplitPoint unit_vector(const Point& p, const Point& center) {
  Difference d = difference(p, center);
  DoubleDouble square = squared_norm(d);
  if (!is_moderate(square.hi)) {
    d = moderate_difference(d, p, center);
    square = squared_norm(d);
  }
  return scaled_to_unit(d, square);
}

}  // namespace rondel::exact
