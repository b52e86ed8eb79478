// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/turn.h"

#include <array>
#include <cmath>

#include "exact/exact_sign.h"
#include "predicates/rung.h"

namespace rondel::predicates {
namespace {

using Pair = std::array<double, 2>;

// The two coordinates that follow the axis cyclically.
Pair seen_along(const Point& p, unsigned axis) {
  if (axis == 0) return {p.y, p.z};
  return axis == 1 ? Pair{p.z, p.x} : Pair{p.x, p.y};
}

// Two differences, a product and a sum: at most 4u (1 + O(u)) relative to the products.
Sign filter(const Pair& o, const Pair& p, const Pair& q) {
  const double left = (p[0] - o[0]) * (q[1] - o[1]);
  const double right = (p[1] - o[1]) * (q[0] - o[0]);
  const double size = std::abs(left) + std::abs(right);
  constexpr double bound = 5 * unit_roundoff;
  return unless_unsure(left - right, size > 0x1p-900 && std::abs(left - right) > bound * size);
}

// Whether both products have a factor 0, as those of points on a coordinate plane have.
bool is_zero_at_sight(const Pair& o, const Pair& p, const Pair& q) {
  return (p[0] == o[0] || q[1] == o[1]) && (p[1] == o[1] || q[0] == o[0]);
}

}  // namespace

Sign turn(const Point& o, const Point& a, const Point& b, unsigned axis) {
  const Pair origin = seen_along(o, axis);
  const Pair p = seen_along(a, axis);
  const Pair q = seen_along(b, axis);
  if (const Sign sign = filter(origin, p, q); sign != Sign::zero) return sign;
  if (is_zero_at_sight(origin, p, q)) return Sign::zero;
  return exact::sign_of_cubic([&](const auto& step) {
    const auto n = cross(step(o, a), step(o, b));
    return axis == 0 ? n.x : (axis == 1 ? n.y : n.z);
  });
}

bool are_collinear(const Point& o, const Point& a, const Point& b) {
  return turn(o, a, b, 0) == Sign::zero && turn(o, a, b, 1) == Sign::zero &&
         turn(o, a, b, 2) == Sign::zero;
}

}  // namespace rondel::predicates
