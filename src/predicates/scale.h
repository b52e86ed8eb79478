// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Vectors multiplied by powers of two, which changes no digit, so that products of coordinates of
// any size neither over- nor underflow.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "predicates/rung.h"

namespace rondel::predicates {

inline constexpr int max_exponent = 1000;

inline double longest_coordinate(const Vector& v) {
  return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}

// e for a size in [2^e, 2^(e+1)); -1023 for 0 and subnormal numbers, 1024 for infinity and NaN.
inline int exponent_of(double v) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(v) >> 52U & 0x7ffU) - 1023;
}

inline int exponent_of(const Vector& v) { return exponent_of(longest_coordinate(v)); }

// Precondition: |exponent| < 1023.
inline double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52U);
}

inline Vector operator*(double factor, const Vector& v) {
  return {factor * v.x, factor * v.y, factor * v.z};
}

// The factor by which v is multiplied to have its longest coordinate in [1, 2), or 0 if there is
// none among the doubles. Other coordinates may become subnormal or 0: off by 2^-1074.
inline double factor_to_one(const Vector& v) {
  const int exponent = exponent_of(v);
  return std::abs(exponent) <= max_exponent ? power_of_two(-exponent) : 0;
}

// Whether the ray to some point has a coordinate, other than 0, so small against another one that
// products with it may be lost, that a tie is unlikely, and that differences of products hardly
// cancel.
template <std::size_t n>
bool have_different_exponents(const std::array<Point, n>& points, const Point& center) {
  constexpr double little = 0x1p-100;
  const auto size = [](double x) {
    return x == 0 ? std::numeric_limits<double>::infinity() : std::abs(x);
  };
  return std::ranges::any_of(points, [&](const Point& p) {
    const Vector v = to_vector(p) - to_vector(center);
    return std::min({size(v.x), size(v.y), size(v.z)}) < little * longest_coordinate(v);
  });
}

// The bound of the errors is relative to the lengths of the three differences from one of four
// points. A point far from the other three makes all of them long unless it is not the one from
// which they are taken: so the even permutation of the four is chosen whose last point has the
// smallest product, to powers of two.
//
//     p . . . . . . . .          |b-p||c-p||d-p| is of order |p|^3,
//          . . . . . . :: d b    |c-b||d-b||p-b| of order |p|
//            . . . . . : c
using OrderOfFour = std::array<std::size_t, 4>;

inline constexpr std::array<OrderOfFour, 4> even_orders_of_four = {
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {2, 1, 3, 0}}};

inline OrderOfFour order_for_best_origin(const std::array<Vector, 4>& points) {
  std::array<int, 4> sums{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const int exponent = exponent_of(points[i] - points[j]);
      sums[i] += exponent;
      sums[j] += exponent;
    }
  }
  return *std::ranges::min_element(even_orders_of_four, {},
                                   [&](const OrderOfFour& o) { return sums[o[3]]; });
}

}  // namespace rondel::predicates
