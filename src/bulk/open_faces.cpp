// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/open_faces.h"

#include <algorithm>
#include <cmath>

#include "predicates/bounds.h"

namespace rondel::bulk {
namespace {

using predicates::Vector;

Cone make_cone(const Square& square, double hand) {
  const auto ratio = [](std::uint64_t position) {
    return std::ldexp(static_cast<double>(position), 1 - order::position_bits) - 1;
  };
  // The directions beyond a limit, in the plane of the third axis and one along the face.
  const auto plane = [](double x, double y, double limit) {
    const double length = std::sqrt(1 + limit * limit);
    return Vector{x / length, y / length, -limit * (x + y) / length};
  };
  const std::uint64_t size = std::uint64_t{1} << square.bits;
  return {plane(1, 0, ratio(square.corner.u)), plane(-1, 0, ratio(square.corner.u + size)),
          plane(0, hand, hand * ratio(square.corner.v)),
          plane(0, -hand, hand * ratio(square.corner.v + size))};
}

}  // namespace

Certificate::Certificate(const Square& square, double hand, bool has_weights)
    : Certificate(make_cone(square, hand), has_weights) {}

// The plane of the face cuts the ball in a circle with center a + x, where x is in the plane and
// 2 x.B = |B|^2 + w_b - w_a, 2 x.C = |C|^2 + w_c - w_a, w = 1 - |p|^2. The cap, less than half of
// the sphere, lies in the ball around this center with the radius of the circle.
// docs/theory/blocks.md derives `slack`, the error of x.
bool Certificate::is_final(const Vector& a, const Vector& b, const Vector& c) const {
  constexpr double unit = predicates::unit_roundoff;
  constexpr double margin = 0x1p-43;
  const Vector to_b = b - a;
  const Vector to_c = c - a;
  const Vector normal = cross(to_b, to_c);
  const double n2 = dot(normal, normal);
  double b2 = dot(to_b, to_b);
  double c2 = dot(to_c, to_c);
  const double n = std::sqrt(n2);
  const double sides = std::sqrt(b2) + std::sqrt(c2);
  if (!(sides < 0x1p44 * n)) return false;
  const double square = b2 * c2 / n2;  // 1 / sin^2 of the angle at a
  double wa = 0;
  if (has_weights_) {
    wa = 1 - dot(a, a) + 0x1p-48;
    b2 -= dot(to_b, a + b);
    c2 -= dot(to_c, a + c);
  }
  const Vector x = (0.5 / n2) * (b2 * cross(to_c, normal) + c2 * cross(normal, to_b));
  const Vector middle = a + x;
  const double size = std::sqrt(dot(x, x));
  const double slack = has_weights_ ? 160 * unit * (sides / n + square)
                                    : 96 * unit * (sides / n) * (size + square * n);
  const double least =
      std::sqrt(std::max((size + slack) * (size + slack) + wa, 0.0)) + slack + margin;
  return std::ranges::all_of(cone_,
                             [&](const Vector& inward) { return dot(inward, middle) > least; });
}

}  // namespace rondel::bulk
