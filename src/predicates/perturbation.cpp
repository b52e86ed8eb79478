// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/perturbation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <tuple>

#include "predicates/orientation.h"
#include "predicates/turn.h"

namespace rondel::predicates {
namespace {

using Triple = std::array<std::size_t, 3>;

// The roles of the four points. Raising one of them changes the determinant in the direction of a
// triple of the others: +(b,c,d) for p, -(p,c,d) for b, +(p,b,d) for c, -(p,b,c) for d. Lowering
// changes it the other way.
constexpr std::size_t role_p = 0;
constexpr std::array<Triple, 4> triple_of = {{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
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

// Returns sorted_roles(points, is_lowered_more), without branches, which would be unpredictable.
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

// What follows finds the first coefficient that is not zero, for sites that are raised.

// The four lie in one plane. If three of them that are not in a line are in a plane with the center,
// it is that plane, and all coefficients are zero. Three points of the unit sphere are in no line.
Sign raise_from_center(const Four& points, const Order& order, Model model, const Point& center) {
  for (const std::size_t role : order) {
    const Triple& t = triple_of[role];
    const Sign sign = orientation(points[t[0]], points[t[1]], points[t[2]], center).sign;
    if (sign != Sign::zero) return factor_of[role] * sign;
    if (model == Model::projected || !are_collinear(points[t[0]], points[t[1]], points[t[2]]))
      break;
  }
  return Sign::zero;
}

// The rest concerns four sites in one plane W with the center, seen along an axis that is not
// parallel to W. The sign of a triple seen from g is its orientation within W, up to one common
// sign.

// Returns the orientation of three distinct rays: that of their circular order. Two of the three
// consecutive pairs turn the same way; a pair of antipodes turns neither way.
Sign orientation_of_rays(const Four& points, const Triple& t, const Point& center, unsigned axis) {
  int turns = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    turns += static_cast<int>(turn(center, points[t[k]], points[t[(k + 1) % 3]], axis));
  }
  return static_cast<Sign>((turns > 0) - (turns < 0));
}

// Points in a line take the sense that raising them from the center gives, first the one that moves
// most: moving x to x(1+e) changes (y-x) x (z-x) by e x x (y-z), and this is e z x y for points in a
// line. Zero if they are in line with the center.
Sign orientation_of_points(const Four& points, const Order& order, const Triple& t,
                           const Point& center, unsigned axis) {
  const Sign sign = turn(points[t[0]], points[t[1]], points[t[2]], axis);
  if (sign != Sign::zero) return sign;
  const auto first = std::ranges::find_first_of(order, t);
  const auto k = static_cast<std::size_t>(std::ranges::find(t, *first) - t.begin());
  return turn(center, points[t[(k + 2) % 3]], points[t[(k + 1) % 3]], axis);
}

// Raising from g: the face (b, c, d) is positive seen from g, because g is inside the hull.
Sign raise_from_inside(const Four& points, const Order& order, Model model, const Point& center) {
  const auto is_parallel = [&](unsigned axis) {
    return turn(center, points[1], points[2], axis) == Sign::zero &&
           turn(center, points[2], points[3], axis) == Sign::zero &&
           turn(center, points[3], points[1], axis) == Sign::zero;
  };
  unsigned axis = 0;
  while (axis < 2 && is_parallel(axis)) ++axis;
  const auto orientation_in_plane = [&](const Triple& t) {
    return model == Model::projected ? orientation_of_rays(points, t, center, axis)
                                     : orientation_of_points(points, order, t, center, axis);
  };
  const Sign face = orientation_in_plane(triple_of[role_p]);
  for (const std::size_t role : order) {
    const Sign sign = orientation_in_plane(triple_of[role]);
    if (sign != Sign::zero) return face * factor_of[role] * sign;
  }
  return Sign::zero;
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
  const Order order = model == Model::projected ? lowering_order(points)
                                                : sorted_roles(points, is_lexicographically_less);
  Sign raised = raise_from_center(points, order, model, center);
  if (raised == Sign::zero) raised = raise_from_inside(points, order, model, center);
  assert(raised != Sign::zero);
  return raised == (model == Model::projected ? Sign::negative : Sign::positive);
}

}  // namespace rondel::predicates
