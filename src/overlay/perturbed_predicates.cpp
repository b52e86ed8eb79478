// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/perturbed_predicates.h"

#include <cmath>

#include "exact/exact_sign.h"
#include "rondel/predicates.h"

namespace rondel::overlay {
namespace {

constexpr double min_size = 1e-100;

// The bound for a coordinate of the first-order change in doubles, relative to |a| |b-a| |y|: u for
// b-a, 3u for a product of three numbers and 3u for each scalar product.
constexpr double change_bound = 16 * predicates::unit_roundoff;

// Returns the sign of the first coordinate that is not zero of a (y.b) - b (y.a) = a (y.d) - d
// (y.a), d = b-a.
Sign sign_of_change(const Point& a, const Point& b, const Point& y) {
  const Point d = b - a;
  const double value = a.x * dot(y, d) - d.x * dot(y, a);
  const double square = dot(a, a) * dot(d, d) * dot(y, y);
  constexpr double min_square = min_size * min_size;
  if (square > min_square && value * value > change_bound * change_bound * square) {
    return exact::sign_of(value);
  }
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

// Returns the sign of det(from, to, p), or zero if it is not known. It uses the normal of the two
// and the difference d from the nearer one to p: at a small distance the sign is lost in rounding
// of the product with p, but not in that with d.
Sign sign_by_nearer_end(const Vec& normal, double limit, const Point& from, const Point& to,
                        const Point& p) {
  const Vec of_from = exact::to_vector(p) - exact::to_vector(from);
  const Vec of_to = exact::to_vector(p) - exact::to_vector(to);
  const Vec& d = dot(of_from, of_from) < dot(of_to, of_to) ? of_from : of_to;
  const double value = dot(normal, d);
  return std::abs(value) > limit * size_of_step(d) ? exact::sign_of(value) : Sign::zero;
}

// Returns the sign of the first coordinate of the change for an end y of the step from a, both unit
// vectors up to rounding, or zero if it is not known.
Sign sign_of_change_at_end(const Point& a, const Vec& step, const Point& y) {
  const Vec end = exact::to_vector(y);
  const double value = a.x * dot(end, step) - step.x * dot(end, exact::to_vector(a));
  return std::abs(value) > change_bound * size_of_step(step) ? exact::sign_of(value) : Sign::zero;
}

}  // namespace

bool TracedLine::is_left_nearby(const Point& y) const {
  Sign sign = y == p_ || y == q_ ? sign_of_change_at_end(p_, step_, y)
                                 : sign_by_nearer_end(normal_, limit_, p_, q_, y);
  if (sign == Sign::zero) sign = turned_point_sign(p_, q_, y);
  return sign == Sign::positive;
}

Sign CoverEdge::nearby_sign(const Point& x) const {
  return sign_by_nearer_end(normal_, line_bound * size_of_step(step_), y_, z_, x);
}

// The change of x by an edge is that of a point by the reversed line.
bool CoverEdge::is_left_nearby(const Point& x) const {
  Sign sign = x == y_ || x == z_ ? -sign_of_change_at_end(z_, step_, x) : nearby_sign(x);
  if (sign == Sign::zero) sign = turned_edge_sign(x, y_, z_);
  return sign == Sign::positive;
}

Sign turned_point_sign(const Point& a, const Point& b, const Point& y) {
  const Sign sign = y == a || y == b ? Sign::zero : orientation(a, b, y);
  return sign != Sign::zero ? sign : sign_of_change(a, b, y);
}

Sign turned_edge_sign(const Point& x, const Point& y, const Point& z) {
  const Sign sign = x == y || x == z ? Sign::zero : orientation(x, y, z);
  return sign != Sign::zero ? sign : sign_of_change(z, y, x);
}

}  // namespace rondel::overlay
