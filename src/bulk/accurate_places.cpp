// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/accurate_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/eft.h"
#include "exact/extended.h"
#include "exact/vector.h"

namespace rondel::bulk {
namespace {

using exact::DoubleDouble;

// Relative to the distance, 16 units of 2^-64. Steps between places have a small relative error
// from this distance on.
constexpr long double orientation_bound = 0x1p-60L;
constexpr long double least_squared_distance = 0x1p-76L;

// The coordinate of a difference along an axis.
DoubleDouble along(const Point& axis, const Point& p, const Point& center) {
  if (axis.x != 0) return exact::two_diff(axis.x * p.x, axis.x * center.x);
  if (axis.y != 0) return exact::two_diff(axis.y * p.y, axis.y * center.y);
  return exact::two_diff(axis.z * p.z, axis.z * center.z);
}

// x/z - quotient, where the quotient is x.hi/z.hi rounded.
double rest(const DoubleDouble& x, const DoubleDouble& z, double quotient) {
  const DoubleDouble product = exact::two_product(quotient, z.hi);
  return (((x.hi - product.hi) - product.lo) + (x.lo - quotient * z.lo)) / z.hi;
}

}  // namespace

void AccuratePlaces::assign(std::span<const Point> sites, std::span<const Index> order,
                            const Point& center) {
  sites_ = sites;
  order_ = order;
  center_ = center;
  lows_.clear();
}

void AccuratePlaces::enter(const SquarePoint* points, unsigned cube_face) {
  points_ = points;
  axes_ = order::cube_axes(cube_face);
  hand_ = det(exact::to_vector(axes_.u), exact::to_vector(axes_.v), exact::to_vector(axes_.out));
}

void AccuratePlaces::find_low(Index i) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Point& p = sites_[order_[i]];
  const SquarePoint& point = points_[i];
  const DoubleDouble z = along(axes_.out, p, center_);
  if (!(z.hi > 0x1p-900 && z.hi < 0x1p900)) {
    lows_[i] = {infinity, infinity};
    return;
  }
  lows_[i] = {rest(along(axes_.u, p, center_), z, point.u),
              hand_ * rest(along(axes_.v, p, center_), z, hand_ * point.v)};
}

const AccuratePlaces::Low& AccuratePlaces::known_low(Index i) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (lows_.empty()) lows_.resize(order_.size(), {unknown, unknown});
  if (std::isnan(lows_[i].u)) find_low(i);
  return lows_[i];
}

Sign AccuratePlaces::orientation(Index a, Index b, Index c) {
  if (!exact::has_extended_precision()) return Sign::zero;
  struct WideStep {
    long double u, v;
    [[nodiscard]] long double squared() const { return u * u + v * v; }
  };
  const SquarePoint& from = points_[a];
  const Low& from_low = known_low(a);
  const auto step_to = [&](Index i) -> WideStep {
    const SquarePoint& to = points_[i];
    const Low& low = known_low(i);
    return {(static_cast<long double>(to.u) - from.u) + (low.u - from_low.u),
            (static_cast<long double>(to.v) - from.v) + (low.v - from_low.v)};
  };
  const WideStep ab = step_to(b);
  const WideStep ac = step_to(c);
  const long double squared = std::max(ab.squared(), ac.squared());
  const long double value = ab.u * ac.v - ab.v * ac.u;
  if (!(squared > least_squared_distance && std::abs(value) > orientation_bound * squared))
    return Sign::zero;
  return value > 0 ? Sign::positive : Sign::negative;
}

}  // namespace rondel::bulk
