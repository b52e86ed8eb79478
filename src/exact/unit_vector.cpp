// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "exact/unit_vector.h"

#include <algorithm>
#include <cmath>

#include "exact/eft.h"

namespace rondel::exact {
namespace {

DoubleDouble scale(DoubleDouble a, int exponent) {
  return {std::ldexp(a.hi, exponent), std::ldexp(a.lo, exponent)};
}

// p - center, times 2^shift for a shift that puts the largest coordinate near 1.
//
// two_diff is exact also for subnormal results. Only a difference beyond 2^1020 is computed from
// quarters, which may drop bits below 2^-1074; then the largest coordinate is above 2^1018, and
// what is dropped is below its 2^-2000th part.
struct Direction {
  DoubleDouble x, y, z;

  Direction(const Point& p, const Point& c) {
    constexpr double limit = 0x1p1020;
    const double quarter = 0.25;
    const auto largest = std::max(
        {std::abs(p.x), std::abs(p.y), std::abs(p.z), std::abs(c.x), std::abs(c.y), std::abs(c.z)});
    x = two_diff(p.x, c.x);
    y = two_diff(p.y, c.y);
    z = two_diff(p.z, c.z);
    if (largest >= limit) {
      const auto is_far = [](const DoubleDouble& d) { return !(std::abs(d.hi) < limit); };
      if (is_far(x) || is_far(y) || is_far(z)) {
        x = two_diff(p.x * quarter, c.x * quarter);
        y = two_diff(p.y * quarter, c.y * quarter);
        z = two_diff(p.z * quarter, c.z * quarter);
      }
    }
    normalize();
  }

 private:
  void normalize() {
    const double size = std::max({std::abs(x.hi), std::abs(y.hi), std::abs(z.hi)});
    if (size > 0x1p-200 && size < 0x1p200) return;
    const int shift = -std::ilogb(size);
    x = scale(x, shift);
    y = scale(y, shift);
    z = scale(z, shift);
  }
};

// The square of a + its low part, to a relative 2^-103.
DoubleDouble square(DoubleDouble a) {
  const DoubleDouble s = two_square(a.hi);
  return fast_two_sum(s.hi, s.lo + 2 * a.hi * a.lo);
}

// The norm to a relative 2^-102: one Newton step from the rounded root.
DoubleDouble norm(const Direction& d) {
  const DoubleDouble s = square(d.x) + square(d.y) + square(d.z);
  const double root = std::sqrt(s.hi);
  const DoubleDouble r2 = two_square(root);
  return fast_two_sum(root, ((s.hi - r2.hi) - r2.lo + s.lo) / (2 * root));
}

DoubleDouble divide(DoubleDouble a, DoubleDouble b) {
  const double q = a.hi / b.hi;
  const DoubleDouble p = two_product(q, b.hi);
  const double rest = ((a.hi - p.hi) - p.lo + a.lo) - q * b.lo;
  return fast_two_sum(q, rest / b.hi);
}

}  // namespace

SplitPoint unit_vector(const Point& p, const Point& center) {
  const Direction d(p, center);
  const DoubleDouble length = norm(d);
  const DoubleDouble x = divide(d.x, length);
  const DoubleDouble y = divide(d.y, length);
  const DoubleDouble z = divide(d.z, length);
  return {{x.hi, y.hi, z.hi}, {x.lo, y.lo, z.lo}};
}

}  // namespace rondel::exact
