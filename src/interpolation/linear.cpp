// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/linear.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "dual/exact_normal.h"
#include "exact/eft.h"
#include "exact/length.h"

namespace rondel::interpolation {
namespace {

using exact::DoubleDouble;
using exact::to_vector;
using Steps = std::array<Vec, 3>;
using Weights3 = std::array<double, 3>;

// Where a product of two steps is so many times the double area of the face, or a weight that small,
// double-double arithmetic takes over: rounding errors would be seen.
constexpr double most_elongated = 16;
constexpr double least_share = 0x1p-40;

// u.(B x C), u.(C x A), u.(A x B).
template <class V>
auto determinants(const V& u, const std::array<V, 3>& s) {
  return std::array{dot(u, cross(s[1], s[2])), dot(u, cross(s[2], s[0])),
                    dot(u, cross(s[0], s[1]))};
}

bool are_well_shaped(const Steps& s, const Weights3& w) {
  const double sum = (w[0] + w[1]) + w[2];
  if (!(std::min({w[0], w[1], w[2]}) > least_share * sum)) return false;
  const Weights3 squares = {dot(s[0], s[0]), dot(s[1], s[1]), dot(s[2], s[2])};
  if (std::min({squares[0], squares[1], squares[2]}) < least_split_step * least_split_step)
    return false;
  const double largest =
      std::max({squares[0] * squares[1], squares[1] * squares[2], squares[2] * squares[0]});
  return largest <= (most_elongated * most_elongated) * (sum * sum);
}

Weights3 wide_determinants(const Ground& ground, const Place& place, const Triple& corners) {
  using Wide = exact::Vector3<DoubleDouble>;
  const exact::SplitPoint& u = place.unit;
  const auto sum = [](double hi, double lo) { return exact::fast_two_sum(hi, lo); };
  std::array<Wide, 3> steps;
  for (std::size_t i = 0; i < 3; ++i) {
    const exact::SplitPoint& x = ground.unit(corners[i]);
    const auto d = exact::difference(x.hi, u.hi);
    steps[i] = {d.x + sum(x.lo.x, -u.lo.x), d.y + sum(x.lo.y, -u.lo.y), d.z + sum(x.lo.z, -u.lo.z)};
  }
  const auto wide =
      determinants(Wide{sum(u.hi.x, u.lo.x), sum(u.hi.y, u.lo.y), sum(u.hi.z, u.lo.z)}, steps);
  return {wide[0].hi, wide[1].hi, wide[2].hi};
}

// Of faces that are smaller than split unit vectors can tell: the same formula with exact steps, times
// one power of two.
Weights3 tiny_determinants(const Ground& ground, const Place& place, const Triple& corners) {
  Steps s;
  for (std::size_t i = 0; i < 3; ++i) s[i] = careful_step(ground, place, corners[i]);
  const double largest =
      std::max({largest_coordinate(s[0]), largest_coordinate(s[1]), largest_coordinate(s[2])});
  const int shift = -std::ilogb(largest);
  for (Vec& v : s) v = {std::ldexp(v.x, shift), std::ldexp(v.y, shift), std::ldexp(v.z, shift)};
  return determinants(to_vector(place.unit.hi), s);
}

// The location says that no weight is negative.
void add_shares(const Triple& corners, Weights3 w, Row& row) {
  for (double& weight : w) weight = std::max(weight, 0.0);
  const double sum = (w[0] + w[1]) + w[2];
  for (std::size_t i = 0; i < 3; ++i) row.push_back({corners[i], w[i] / sum});
}

// Counterclockwise from the lowest.
Triple canonical(Triple corners) {
  std::ranges::rotate(corners, std::ranges::min_element(corners));
  return corners;
}

}  // namespace

Vec exact_step(const Ground& ground, const Place& place, Index vertex) {
  const auto exact =
      dual::exact_projected_difference(place.point, ground.point(vertex), ground.center());
  return exact.length * exact.direction;
}

void weigh_on_edge(const Ground& ground, const Place& place, Row& row) {
  Index a = place.location.sites[0];
  Index b = place.location.sites[1];
  // Ranks of a ring may begin anywhere.
  const auto coordinates = [&](Index v) {
    const Point& p = ground.point(v);
    return std::tuple(p.x, p.y, p.z);
  };
  if (coordinates(b) < coordinates(a)) std::swap(a, b);
  const Vec u = to_vector(place.unit.hi);
  const double from_a = exact::length_of(cross(u, careful_step(ground, place, a)));
  const double from_b = exact::length_of(cross(u, careful_step(ground, place, b)));
  const double sum = from_a + from_b;
  row.push_back({a, from_b / sum});
  row.push_back({b, from_a / sum});
}

void LinearKernel::operator()(const Place& place, Row& row) const {
  if (place.location.where == Where::edge) {
    weigh_on_edge(ground_, place, row);
    return;
  }
  const Triple corners = canonical(place.location.sites);
  const Steps s = {step(place.unit, ground_.unit(corners[0])),
                   step(place.unit, ground_.unit(corners[1])),
                   step(place.unit, ground_.unit(corners[2]))};
  const Weights3 w = determinants(to_vector(place.unit.hi), s);
  if (are_well_shaped(s, w)) {
    add_shares(corners, w, row);
  } else if (std::ranges::all_of(s, is_split_enough)) {
    add_shares(corners, wide_determinants(ground_, place, corners), row);
  } else {
    add_shares(corners, tiny_determinants(ground_, place, corners), row);
  }
}

}  // namespace rondel::interpolation
