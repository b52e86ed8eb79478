// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/signs.h"

#include <cmath>

#include "exact/exact_sign.h"
#include "rondel/predicates.h"

namespace rondel::overlay {
namespace {

constexpr double least_size = 1e-100;

// Of a coordinate of the change in doubles, relative to |a| |b-a| |y|: u for b-a, 3u for a product of
// three and 3u for each scalar product.
constexpr double change_bound = 16 * predicates::unit_roundoff;

// The sign of the first coordinate that is not zero of a (y.b) - b (y.a) = a (y.d) - d (y.a) with
// d = b-a.
Sign sign_of_change(const Point& a, const Point& b, const Point& y) {
  const Point d = b - a;
  const double value = a.x * dot(y, d) - d.x * dot(y, a);
  const double size = norm(a) * norm(d) * norm(y);
  if (size > least_size && std::abs(value) > change_bound * size) return exact::sign_of(value);
  const auto coordinate = [&](auto axis) {
    return exact::sign_of_cubic([&](const auto& step) {
      const auto u = step(Point{}, a);
      const auto v = step(Point{}, b);
      const auto w = step(Point{}, y);
      return axis(u) * dot(w, v) - axis(v) * dot(w, u);
    });
  };
  Sign sign = coordinate([](const auto& v) { return v.x; });
  if (sign == Sign::zero) sign = coordinate([](const auto& v) { return v.y; });
  if (sign == Sign::zero) sign = coordinate([](const auto& v) { return v.z; });
  return sign;
}

}  // namespace

Sign turned_point_sign(const Point& a, const Point& b, const Point& y) {
  const Sign sign = y == a || y == b ? Sign::zero : orientation(a, b, y);
  return sign != Sign::zero ? sign : sign_of_change(a, b, y);
}

Sign turned_edge_sign(const Point& x, const Point& y, const Point& z) {
  const Sign sign = x == y || x == z ? Sign::zero : orientation(x, y, z);
  return sign != Sign::zero ? sign : sign_of_change(z, y, x);
}

}  // namespace rondel::overlay
