// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/collinear.h"

#include <array>
#include <cmath>

#include "exact/integer.h"
#include "predicates/bounds.h"

namespace rondel::bulk {
namespace {

using Vector = exact::Vector3<double>;

// The sign of (a x b).(c x d), or zero if it is not certain. The vectors are rounded differences,
// so a cross product is off by at most 7 units times two lengths, and the value by 17 units times
// all four; the rest is for roundings of the lengths.
Sign certain_sign(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  constexpr double bound = 32 * predicates::unit_roundoff;
  constexpr double min_scale = 1e-150;  // below it, bits may be lost to underflow
  const double value = dot(cross(a, b), cross(c, d));
  const double first = std::sqrt(dot(a, a)) * std::sqrt(dot(b, b));
  const double second = std::sqrt(dot(c, c)) * std::sqrt(dot(d, d));
  const bool is_certain =
      first > min_scale && second > min_scale && std::abs(value) > bound * (first * second);
  return is_certain ? exact::sign_of(value) : Sign::zero;
}

}  // namespace

Between is_between(const Point& a, const Point& m, const Point& b, const Point& center) {
  const auto difference = [](const Point& p, const Point& q) {
    return exact::to_vector(p) - exact::to_vector(q);
  };
  const std::array ray = {difference(a, center), difference(m, center), difference(b, center)};
  const Sign after_a = certain_sign(ray[0], ray[1], ray[0], ray[2]);
  const Sign before_b = certain_sign(ray[1], ray[2], ray[0], ray[2]);
  if (after_a == Sign::negative || before_b == Sign::negative) return Between::no;
  if (after_a == Sign::positive && before_b == Sign::positive) {
    const Sign above = certain_sign(difference(m, a), difference(b, a), ray[0], ray[2]);
    if (above != Sign::zero) return above == Sign::positive ? Between::yes : Between::below;
  }

  const auto v = exact::scaled_differences({a, m, b}, center);
  const auto ab = cross(v[0], v[2]);
  if (dot(cross(v[0], v[1]), ab) <= 0 || dot(cross(v[1], v[2]), ab) <= 0) return Between::no;
  return dot(cross(v[1] - v[0], v[2] - v[0]), ab) > 0 ? Between::yes : Between::below;
}

}  // namespace rondel::bulk
