// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/ray_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "exact/exact_sign.h"
#include "predicates/rung.h"

namespace rondel::predicates {
namespace {

template <std::size_t N>
exact::Ball<N> along(const exact::BallVector<N>& v, std::size_t axis) {
  return axis == 0 ? v.x : (axis == 1 ? v.y : v.z);
}

double along(const Vector& v, std::size_t axis) {
  return axis == 0 ? v.x : (axis == 1 ? v.y : v.z);
}

// Compares two products of rounded differences. Their difference is off by at most 4u (1 + O(u))
// relative to the products.
Sign compare_slopes_filter(const Vector& v, const Vector& w, std::size_t i, std::size_t axis) {
  const double left = along(v, i) * along(w, axis);
  const double right = along(w, i) * along(v, axis);
  const double size = std::abs(left) + std::abs(right);
  constexpr double bound = 5 * unit_roundoff;
  return unless_unsure(left - right, size > 0x1p-900 && std::abs(left - right) > bound * size);
}

// Whether the ray to a is longer along axis i than along axis j.
bool is_longer_along(const Point& a, const Point& center, std::size_t i, std::size_t j) {
  const auto size = [](double p, double o) { return std::abs(p - o); };
  const std::array<double, 3> rounded = {size(a.x, center.x), size(a.y, center.y),
                                         size(a.z, center.z)};
  if (rounded[i] != rounded[j] || center == Point{}) return rounded[i] > rounded[j];
  return exact::sign_of_cubic([&](const auto& step) {
           const auto v = step(center, a);
           return along(v, i) * along(v, i) - along(v, j) * along(v, j);
         }) == Sign::positive;
}

}  // namespace

Sign compare_rays(const Point& a, const Point& b, const Point& center) {
  if (a == b) return Sign::zero;
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (is_longer_along(a, center, i, axis)) axis = i;
  }
  const Vector rounded_v = to_vector(a) - to_vector(center);
  const Vector rounded_w = to_vector(b) - to_vector(center);
  const auto compare_slopes = [&](std::size_t i) {
    const Sign filtered = compare_slopes_filter(rounded_v, rounded_w, i, axis);
    if (filtered != Sign::zero) return filtered;
    return exact::sign_of_cubic([&](const auto& step) {
      const auto v = step(center, a);
      const auto w = step(center, b);
      return along(v, i) * along(w, axis) - along(w, i) * along(v, axis);
    });
  };
  const Sign sign = compare_slopes((axis + 1) % 3);
  return sign != Sign::zero ? sign : compare_slopes((axis + 2) % 3);
}

namespace {

// True if doubles show that two points are on different rays: with v and w off by u of themselves, a
// coordinate of v x w is off by less than 2^-51 |v| |w|, with sums of coordinates for the lengths.
bool are_surely_on_different_rays(const Point& a, const Point& b, const Point& center) {
  constexpr double bound = 0x1p-48;
  constexpr double least = 0x1p-900;  // products may underflow below it
  const Vector v = to_vector(a) - to_vector(center);
  const Vector w = to_vector(b) - to_vector(center);
  const Vector normal = cross(v, w);
  const double lengths = (std::abs(v.x) + std::abs(v.y) + std::abs(v.z)) *
                         (std::abs(w.x) + std::abs(w.y) + std::abs(w.z));
  const double largest = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
  return lengths > least && lengths < 1 / least && largest > bound * lengths;
}

}  // namespace

bool are_on_one_ray(const Point& a, const Point& b, const Point& center) {
  if (are_surely_on_different_rays(a, b, center)) return false;
  const auto product = [&](auto formula) {
    return exact::sign_of_cubic(
        [&](const auto& step) { return formula(step(center, a), step(center, b)); });
  };
  const auto is_zero = [&](std::size_t axis) {
    return product([axis](const auto& v, const auto& w) { return along(cross(v, w), axis); }) ==
           Sign::zero;
  };
  return is_zero(0) && is_zero(1) && is_zero(2) &&
         product([](const auto& v, const auto& w) { return dot(v, w); }) == Sign::positive;
}

}  // namespace rondel::predicates
