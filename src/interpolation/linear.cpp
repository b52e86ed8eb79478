// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/linear.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "dual/split_sites.h"
#include "exact/eft.h"
#include "exact/vector.h"

namespace rondel::interpolation {
namespace {

using exact::DoubleDouble;
using exact::to_vector;
using Steps = std::array<Vec, 3>;

// Split unit vectors have errors of 2^-100, and so have steps. With the largest step L and the sum
// S of the determinants, which is twice the area of the face, weights have errors of 2^-100 L/S.
// Rounding errors of doubles add about 2^-50 P/S, where P is the product of the two largest steps.
constexpr double min_sum = 0x1p-46;   // lower bound of S/L
constexpr double max_elongated = 16;  // upper bound of P/S for doubles

// Returns u.(B x C), u.(C x A) and u.(A x B).
template <class V>
auto determinants(const V& u, const std::array<V, 3>& s) {
  return std::array{dot(u, cross(s[1], s[2])), dot(u, cross(s[2], s[0])),
                    dot(u, cross(s[0], s[1]))};
}

double sum_of(const Weights3& w) { return (w[0] + w[1]) + w[2]; }

double largest_square(const Steps& s) {
  return std::max({dot(s[0], s[0]), dot(s[1], s[1]), dot(s[2], s[2])});
}

bool is_enough(double sum, double largest_step_squared) {
  return sum > 0 && sum * sum >= min_sum * min_sum * largest_step_squared;
}

bool are_well_shaped(const Steps& s, const Weights3& w) {
  const double sum = sum_of(w);
  const Weights3 squares = {dot(s[0], s[0]), dot(s[1], s[1]), dot(s[2], s[2])};
  const double product =
      std::max({squares[0] * squares[1], squares[1] * squares[2], squares[2] * squares[0]});
  return product <= (max_elongated * max_elongated) * (sum * sum) &&
         is_enough(sum, std::max({squares[0], squares[1], squares[2]}));
}

using Wide = exact::Vector3<DoubleDouble>;

Wide wide_sum(const Point& hi, const Point& lo) {
  return {exact::fast_two_sum(hi.x, lo.x), exact::fast_two_sum(hi.y, lo.y),
          exact::fast_two_sum(hi.z, lo.z)};
}

Weights3 wide_determinants(const exact::SplitPoint& unit,
                           const std::array<exact::SplitPoint, 3>& x) {
  const Wide u = wide_sum(unit.hi, unit.lo);
  const auto wide =
      determinants(u, std::array{wide_sum(x[0].hi, x[0].lo) - u, wide_sum(x[1].hi, x[1].lo) - u,
                                 wide_sum(x[2].hi, x[2].lo) - u});
  return {wide[0].hi, wide[1].hi, wide[2].hi};
}

// The location says that no weight is negative, so negative ones are rounding errors.
void add_shares(const Triple& corners, Weights3 w, Row& row) {
  for (double& weight : w) weight = std::max(weight, 0.0);
  const double sum = sum_of(w);
  row.resize(3);
  for (std::size_t i = 0; i < 3; ++i) row[i] = {corners[i], w[i] / sum};
}

// Returns the corners counterclockwise from the lowest.
Triple canonical(Triple corners) {
  std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
  return corners;
}

}  // namespace

Vec exact_step(const PreparedTriangulation& prepared, const LocatedTarget& place, Index vertex) {
  const auto exact =
      dual::exact_projected_difference(place.point, prepared.point(vertex), prepared.center());
  return exact.length * exact.direction;
}

void weigh_on_edge(const PreparedTriangulation& prepared, const LocatedTarget& place, Row& row) {
  Index a = place.location.sites[0];
  Index b = place.location.sites[1];
  // Since the ring may begin with any rank, the order is decided by coordinates.
  const auto coordinates = [&](Index v) {
    const Point& p = prepared.point(v);
    return std::tuple(p.x, p.y, p.z);
  };
  if (coordinates(b) < coordinates(a)) std::swap(a, b);
  const Vec u = to_vector(place.unit.hi);
  double from_a = exact::length_of(cross(u, step(place.unit, prepared.unit(a))));
  double from_b = exact::length_of(cross(u, step(place.unit, prepared.unit(b))));
  if (from_a + from_b < min_sum) {
    from_a = exact::length_of(cross(u, exact_step(prepared, place, a)));
    from_b = exact::length_of(cross(u, exact_step(prepared, place, b)));
  }
  const double sum = from_a + from_b;
  const double share = sum > 0 ? from_b / sum : 0.5;  // both distances may be below the range of
                                                      // doubles
  row.push_back({a, share});
  row.push_back({b, sum > 0 ? from_a / sum : 0.5});
}

Weights3 LinearKernel::careful_weights(const LocatedTarget& place, const Triple& corners,
                                       double largest_step_squared) const {
  const Weights3 wide = wide_determinants(
      place.unit,
      {prepared_.unit(corners[0]), prepared_.unit(corners[1]), prepared_.unit(corners[2])});
  if (is_enough(sum_of(wide), largest_step_squared)) return wide;
  return dual::exact_weights(
      {prepared_.point(corners[0]), prepared_.point(corners[1]), prepared_.point(corners[2])},
      place.point, prepared_.center());
}

void LinearKernel::operator()(const LocatedTarget& place, Row& row) const {
  if (place.location.where == Where::edge) {
    weigh_on_edge(prepared_, place, row);
    return;
  }
  const Triple corners = canonical(place.location.sites);
  const Steps s = {step(place.unit, prepared_.unit(corners[0])),
                   step(place.unit, prepared_.unit(corners[1])),
                   step(place.unit, prepared_.unit(corners[2]))};
  Weights3 w = determinants(to_vector(place.unit.hi), s);
  if (!are_well_shaped(s, w)) w = careful_weights(place, corners, largest_square(s));
  add_shares(corners, w, row);
}

}  // namespace rondel::interpolation
