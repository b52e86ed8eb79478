// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/orientation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "exact/eft.h"
#include "exact/exact_sign.h"
#include "exact/integer_signs.h"
#include "predicates/scale.h"
#include "predicates/wide.h"

namespace rondel::predicates {
namespace {

struct Corner {
  Vector ray;  // from the center
  Vector point;
};

// Where the center is 0, rays of very different lengths take the same one, as their lengths do not
// count: so their differences are those of directions.
std::array<Corner, 3> corners_of(const Point& a, const Point& b, const Point& c,
                                 const Point& center) {
  std::array<Corner, 3> corners = {{{{}, to_vector(a)}, {{}, to_vector(b)}, {{}, to_vector(c)}}};
  std::array<int, 3> exponents{};
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i].ray = corners[i].point - to_vector(center);
    exponents[i] = exponent_of(corners[i].ray);
  }
  const auto [lowest, highest] = std::ranges::minmax(exponents);
  if (highest - lowest > 1 && center == Point{}) {
    for (Corner& corner : corners) {
      corner.ray = corner.point = factor_to_one(corner.point) * corner.point;
    }
  }
  return corners;
}

Sign filter(const Point& a, const Point& b, const Point& c, const Point& center) {
  const Vector ray = to_vector(a) - to_vector(center);
  const Vector ab = to_vector(b) - to_vector(a);
  const Vector ac = to_vector(c) - to_vector(a);
  const double value = det(ray, ab, ac);
  return unless_unsure(value, is_orientation_certain(value, ray, ab, ac));
}

// The filter for points of any size: each vector takes its own power of two.
// The bound is relative to the lengths of the differences, of which those from the best corner are
// the two shortest. All three vectors may be of any size.
Sign filter_of_scaled(const Point& a, const Point& b, const Point& c, const Point& center) {
  const std::array<Corner, 3> corners = corners_of(a, b, c, center);
  std::array<Vector, 3> sides{};
  std::array<double, 3> sizes{};
  for (std::size_t i = 0; i < 3; ++i) {
    sides[i] = corners[(i + 1) % 3].point - corners[i].point;
    sizes[i] = longest_coordinate(sides[i]);
  }
  const auto longest = static_cast<std::size_t>(std::ranges::max_element(sizes) - sizes.begin());
  const std::size_t best = (longest + 2) % 3;
  const auto scaled_to_one = [](const Vector& v) { return factor_to_one(v) * v; };
  const Vector ray = scaled_to_one(corners[best].ray);
  const Vector to = scaled_to_one(sides[best]);
  const Vector from = scaled_to_one(sides[(best + 2) % 3]);
  // det(a-o, b-a, c-a) = det(a-o, a-c, b-a), and cyclically.
  const double value = det(ray, from, to);
  return unless_unsure(
      value, is_beyond(value, orientation_bound, dot(ray, ray), dot(from, from), dot(to, to)));
}

// For coordinates of different magnitudes.
Sign wide_filter(const Point& a, const Point& b, const Point& c, const Point& center) {
  const Vector o = to_vector(center);
  return det_of_rows(to_floating(to_vector(a) - o), to_floating(to_vector(b) - o),
                     to_floating(to_vector(c) - o))
      .sign_if_beyond(orientation_wide_bound);
}

}  // namespace

// No product of six differences of doubles leaves the range of long double.
Sign orientation_extended(const Point& a, const Point& b, const Point& c, const Point& center) {
  constexpr long double bound = orientation_bound / unit_roundoff * exact::extended_unit_roundoff;
  if (!exact::has_extended_precision()) return Sign::zero;
  using Step = exact::Vector3<long double>;
  const auto step = [](const Point& from, const Point& to) -> Step {
    return {static_cast<long double>(to.x) - from.x, static_cast<long double>(to.y) - from.y,
            static_cast<long double>(to.z) - from.z};
  };
  const Step ray = step(center, a);
  const Step ab = step(a, b);
  const Step ac = step(a, c);
  const long double value = det(ray, ab, ac);
  if (!(value * value > bound * bound * dot(ray, ray) * dot(ab, ab) * dot(ac, ac)))
    return Sign::zero;
  return value > 0 ? Sign::positive : Sign::negative;
}

Decision orientation(const Point& a, const Point& b, const Point& c, const Point& center) {
  if (const Sign sign = filter(a, b, c, center); sign != Sign::zero) return {sign, Rung::filter};
  if (const Sign sign = orientation_extended(a, b, c, center); sign != Sign::zero) {
    return {sign, Rung::extended};
  }
  if (have_different_exponents(std::array{a, b, c}, center)) {
    if (const Sign sign = wide_filter(a, b, c, center); sign != Sign::zero)
      return {sign, Rung::filter};
  }
  if (const auto sign = exact::sign_of_volume_in_integers(center, a, b, c)) {
    return {*sign, Rung::exact};
  }
  if (const Sign sign = filter_of_scaled(a, b, c, center); sign != Sign::zero) {
    return {sign, Rung::filter};
  }
  const auto formula = [&](const auto& step) {
    return det(step(center, a), step(center, b), step(center, c));
  };
  return {exact::sign_of_cubic(formula), Rung::exact};
}

}  // namespace rondel::predicates
