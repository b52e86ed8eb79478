// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/accurate_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bulk/tangent_step.h"
#include "exact/eft.h"
#include "exact/extended.h"
#include "exact/vector.h"

namespace rondel::bulk {
namespace {

using exact::DoubleDouble;

// Relative to the distance, in units of 2^-64: 16 and 256. Steps between places have a small
// relative error from this distance on.
constexpr long double orientation_bound = 0x1p-60L;
constexpr long double conflict_bound = 0x1p-56L;
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

Sign sign_beyond(long double value, long double bound) {
  return std::abs(value) > bound ? static_cast<Sign>(value > 0 ? 1 : -1) : Sign::zero;
}

}  // namespace

void AccuratePlaces::assign(std::span<const Point> sites, std::span<const Index> order,
                            const Point& center) {
  sites_ = sites;
  order_ = order;
  center_ = center;
  lows_.clear();
}

void AccuratePlaces::enter(const CellPoint* points, unsigned cube_face) {
  points_ = points;
  axes_ = blocks::cube_axes(cube_face);
  hand_ = det(exact::to_vector(axes_.u), exact::to_vector(axes_.v), exact::to_vector(axes_.out));
}

void AccuratePlaces::find_low(Index i) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Point& p = sites_[order_[i]];
  const CellPoint& point = points_[i];
  const DoubleDouble z = along(axes_.out, p, center_);
  if (!(z.hi > 0x1p-900 && z.hi < 0x1p900)) {
    lows_[i] = {infinity, infinity, infinity};
    return;
  }
  const double u = rest(along(axes_.u, p, center_), z, point.u);
  const double v = hand_ * rest(along(axes_.v, p, center_), z, hand_ * point.v);
  const long double x = static_cast<long double>(point.u) + u;
  const long double y = static_cast<long double>(point.v) + v;
  lows_[i] = {u, v, static_cast<double>(std::sqrt(1 + (x * x + y * y)) - point.size)};
}

void AccuratePlaces::reserve_lows() {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  lows_.resize(order_.size(), {unknown, unknown, unknown});
}

// From the site a.
class AccuratePlaces::Steps {
 public:
  Steps(AccuratePlaces& places, Index a) : places_(places), point_(places.points_[a]) {
    if (places.lows_.empty()) places.reserve_lows();
    low_ = known_low(a);
    from_ = {static_cast<long double>(point_.u) + low_.u,
             static_cast<long double>(point_.v) + low_.v,
             static_cast<long double>(point_.size) + low_.size};
  }

  [[nodiscard]] TangentStep<long double> to(Index b) const {
    const CellPoint& point = places_.points_[b];
    const Low& low = known_low(b);
    return tangent_step<long double>(
        from_, (static_cast<long double>(point.u) - point_.u) + (low.u - low_.u),
        (static_cast<long double>(point.v) - point_.v) + (low.v - low_.v),
        static_cast<long double>(point.size) + low.size);
  }

 private:
  [[nodiscard]] const Low& known_low(Index i) const {
    const Low& low = places_.lows_[i];
    if (std::isnan(low.u)) places_.find_low(i);
    return low;
  }

  AccuratePlaces& places_;
  const CellPoint& point_;
  Low low_{};
  SurfacePoint<long double> from_{};
};

Sign AccuratePlaces::orientation(Index a, Index b, Index c) {
  if (!exact::has_extended_precision()) return Sign::zero;
  const Steps from(*this, a);
  const auto ab = from.to(b);
  const auto ac = from.to(c);
  const long double squared = std::max(ab.squared, ac.squared);
  if (!(squared > least_squared_distance)) return Sign::zero;
  return sign_beyond(ab.u * ac.v - ab.v * ac.u, orientation_bound * squared);
}

Sign AccuratePlaces::side_of_face(Index a, Index b, Index c, Index p) {
  if (!exact::has_extended_precision()) return Sign::zero;
  const Steps from(*this, a);
  const auto ab = from.to(b);
  const auto ac = from.to(c);
  const auto ap = from.to(p);
  const long double squared = max_squared(ab, ac, ap);
  if (!(squared > least_squared_distance)) return Sign::zero;
  return sign_beyond(volume(ab, ac, ap), conflict_bound * (squared * squared));
}

}  // namespace rondel::bulk
