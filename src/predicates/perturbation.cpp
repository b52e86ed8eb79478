// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/perturbation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <tuple>

#include "exact/integer.h"
#include "predicates/orientation.h"
#include "predicates/turn.h"

namespace rondel::predicates {
namespace {

using exact::IntegerVector;

// The roles of the four points. Raising one of them changes the determinant in the direction of a
// triple of the others: +(b,c,d) for p, -(p,c,d) for b, +(p,b,d) for c, -(p,b,c) for d. Lowering
// changes it the other way.
constexpr std::size_t role_p = 0;
constexpr std::array<std::array<std::size_t, 3>, 4> triple_of = {
    {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
constexpr std::array<Sign, 4> factor_of = {Sign::positive, Sign::negative, Sign::positive,
                                           Sign::negative};

using Four = std::array<Point, 4>;
using Order = std::array<std::size_t, 4>;

// The roles, from the site that moves most to the one that moves least.
template <class Compare>
Order sorted_roles(const Four& points, Compare moves_more) {
  Order order = {0, 1, 2, 3};
  std::ranges::sort(order,
                    [&](std::size_t i, std::size_t j) { return moves_more(points[i], points[j]); });
  return order;
}

// As sorted_roles(points, is_lowered_more), without branches that nothing would predict.
Order lowering_order(const Four& points) {
  std::array<std::uint64_t, 4> keys{};
  std::ranges::transform(points, keys.begin(), lowering_key);
  Order place{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (keys[i] == keys[j]) [[unlikely]]
        return sorted_roles(points, is_lowered_more);
      const bool is_later = keys[i] > keys[j];
      place[i] += static_cast<std::size_t>(is_later);
      place[j] += static_cast<std::size_t>(!is_later);
    }
  }
  Order order{};
  for (std::size_t i = 0; i < 4; ++i) order[place[i]] = i;
  return order;
}

// The first coefficient that is not zero, for sites that are raised.
template <class SignOfTriple>
Sign first_sign(const Order& order, SignOfTriple sign_of_triple) {
  for (const std::size_t role : order) {
    const Sign sign = sign_of_triple(triple_of[role]);
    if (sign != Sign::zero) return factor_of[role] * sign;
  }
  return Sign::zero;
}

Sign raise_from_center(const Four& points, const Order& order, const Point& center) {
  return first_sign(order, [&](const std::array<std::size_t, 3>& t) {
    return orientation(points[t[0]], points[t[1]], points[t[2]], center).sign;
  });
}

// What follows concerns four sites in one plane W with the center. The sign of a triple seen from g
// is its orientation within W, up to one common sign.

// Orientation in W of three distinct rays, seen along an axis that is not parallel to W: that of
// their circular order. Two of the three consecutive pairs turn the same way; a pair of antipodes
// turns neither way.
Sign circular_order(const Point& x, const Point& y, const Point& z, const Point& center,
                    unsigned axis) {
  const int turns = static_cast<int>(turn(center, x, y, axis)) +
                    static_cast<int>(turn(center, y, z, axis)) +
                    static_cast<int>(turn(center, z, x, axis));
  return static_cast<Sign>((turns > 0) - (turns < 0));
}

// A vector of W's normal direction whose sense is the orientation of the corners in W. Collinear
// corners take the sense that raising them from the center gives: moving
// x to x(1+e) changes (y-x) x (z-x) by e x x (y-z). Zero if they are in line with the center.
IntegerVector oriented_normal(const std::array<IntegerVector, 4>& v, const Order& order,
                              const std::array<std::size_t, 3>& triple) {
  const IntegerVector& x = v[triple[0]];
  IntegerVector normal = cross(v[triple[1]] - x, v[triple[2]] - x);
  if (!is_zero(normal)) return normal;
  for (const std::size_t role : order) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (triple[k] != role) continue;
      IntegerVector raised = cross(v[role], v[triple[(k + 1) % 3]] - v[triple[(k + 2) % 3]]);
      if (!is_zero(raised)) return raised;
    }
  }
  return normal;
}

// Raising from g: the face (b, c, d) is positive seen from g, because g is inside the hull.
template <class OrientationInPlane>
Sign raise_from_inside(const Order& order, OrientationInPlane orientation_in_plane) {
  const Sign face = orientation_in_plane(triple_of[role_p]);
  return face * first_sign(order, orientation_in_plane);
}

Sign raise_rays_from_inside(const Four& points, const Order& order, const Point& center) {
  const auto is_parallel = [&](unsigned axis) {
    return turn(center, points[1], points[2], axis) == Sign::zero &&
           turn(center, points[2], points[3], axis) == Sign::zero;
  };
  unsigned axis = 0;
  while (axis < 2 && is_parallel(axis)) ++axis;
  return raise_from_inside(order, [&](const std::array<std::size_t, 3>& t) {
    return circular_order(points[t[0]], points[t[1]], points[t[2]], center, axis);
  });
}

Sign raise_points_from_inside(const Four& points, const Order& order, const Point& center) {
  const auto d = exact::scaled_differences({points[0], points[1], points[2], points[3]}, center);
  const std::array<IntegerVector, 4> v = {d[0], d[1], d[2], d[3]};
  const IntegerVector normal = oriented_normal(v, order, triple_of[role_p]);
  return raise_from_inside(order, [&](const std::array<std::size_t, 3>& t) {
    return exact::sign_of(dot(oriented_normal(v, order, t), normal));
  });
}

bool is_in_conflict_projected(const Four& points, const Point& center) {
  const Order order = lowering_order(points);
  Sign raised = raise_from_center(points, order, center);
  if (raised == Sign::zero) raised = raise_rays_from_inside(points, order, center);
  assert(raised != Sign::zero);
  return raised == Sign::negative;
}

bool is_in_conflict_weighted(const Four& points, const Point& center) {
  const Order order = sorted_roles(points, is_lexicographically_less);
  Sign raised = raise_from_center(points, order, center);
  if (raised == Sign::zero) raised = raise_points_from_inside(points, order, center);
  assert(raised != Sign::zero);
  return raised == Sign::positive;
}

}  // namespace

bool is_lexicographically_less(const Point& a, const Point& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// The multipliers are the fractional parts of the square roots of 2, 3 and 5, made odd.
std::uint64_t lowering_key(const Point& p) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x); };
  const auto mixed = [](std::uint64_t x, std::uint64_t odd) { return (x ^ (x >> 32)) * odd; };
  std::uint64_t key = mixed(bits(p.x), 0x6a09e667f3bcc909);
  key = mixed(key + bits(p.y), 0xbb67ae8584caa73b);
  key = mixed(key + bits(p.z), 0x3c6ef372fe94f82b);
  return mixed(key, 0x6a09e667f3bcc909);
}

bool is_lowered_more(const Point& a, const Point& b) {
  const std::uint64_t i = lowering_key(a);
  const std::uint64_t j = lowering_key(b);
  return i != j ? i < j : is_lexicographically_less(a, b);
}

bool is_in_conflict_perturbed(const Point& b, const Point& c, const Point& d, const Point& p,
                              Model model, const Point& center) {
  const Four points = {p, b, c, d};
  return model == Model::projected ? is_in_conflict_projected(points, center)
                                   : is_in_conflict_weighted(points, center);
}

}  // namespace rondel::predicates
