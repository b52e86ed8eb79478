// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/square_sites.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "order/cube_position.h"
#include "predicates/bounds.h"
#include "predicates/conflict.h"
#include "system/prefetch.h"
#include "system/wide_vectors.h"

namespace rondel::bulk {
namespace {

using predicates::unit_roundoff;
using predicates::Vector;
using system::choose;
using system::mask;

// u and v are off by at most 3 units: a difference in each coordinate, and the quotient. In units:
// 2 * 2 * 3 sqrt(2) for the ends of two vectors, relative to the distance, and 5 * 2.83, the
// largest distance, for the roundings of differences, products and their difference; 1.2 for terms
// of higher order.
constexpr double orientation_bound = 38 * unit_roundoff;

// No bound is below this: products of what is smaller may lose bits to underflow.
constexpr double min_bound = 1e-280;

// The error of N.(y-l) with weights, relative to the square of the largest distance: 6 eta for the
// ends of three vectors, where eta is the error of a point, and 8.8 units times the distance for
// the roundings (docs/theory/filters.md); 1.2 for terms of higher order.
double find_weighted_bound(double w_error, double max_w_distance) {
  constexpr double max_uv = 2.83;
  const double eta = unit_roundoff * std::sqrt(3 * 3 + 3 * 3 + w_error * w_error);
  const double distance = std::sqrt(max_uv * max_uv + max_w_distance * max_w_distance);
  return 1.2 * (6 * eta + 8.8 * unit_roundoff * distance);
}

// The surface w = sqrt(1 + u^2 + v^2) and its tangent plane above the middle of a square.
class Tangent {
 public:
  Tangent(const Square& square, double hand) {
    const auto ratio = [&square](std::uint64_t position) {
      const auto middle = static_cast<double>(position) + std::ldexp(0.5, square.bits);
      return std::ldexp(middle, 1 - order::position_bits) - 1;
    };
    u_ = ratio(square.corner.u);
    v_ = hand * ratio(square.corner.v);
    w_ = std::sqrt(1 + (u_ * u_ + v_ * v_));
  }

  // The height of the surface over the plane, where w is the third coordinate of the surface. The
  // differences of w and of the plane from w_ nearly cancel, so they are not computed.
  [[nodiscard]] RONDEL_ALWAYS_INLINE double height(double u, double v, double w) const {
    const double du = u - u_;
    const double dv = v - v_;
    const double squared = du * du + dv * dv;
    const double along = u_ * du + v_ * dv;
    const double sum = w + w_;
    return (squared * w_ - along * (2 * along + squared) / sum) / (w_ * sum);
  }

 private:
  double u_;
  double v_;
  double w_;
};

// A step d = (u, v) on the surface w(x) = sqrt(1 + |x|^2) from a place x to a place y. The height is
// the one over the tangent plane at x times w(x), which is the same for all steps from x:
//
//     w(x) w(y) - w(x)^2 - x.d = (|d|^2 w(x) - x.d (2 x.d + |d|^2) / (w(x) + w(y))) / (w(x) + w(y))
struct TangentStep {
  TangentStep(const SquarePoint& x, const SquarePoint& y)
      : u(y.u - x.u), v(y.v - x.v), squared(u * u + v * v) {
    const double along = x.u * u + x.v * v;
    const double factor = 1 / (x.size + y.size);  // w is the size in the projected model
    height = (squared * x.size - along * (2 * along + squared) * factor) * factor;
  }

  double u;
  double v;
  double squared;
  double height;
};

// floor((ratio + 1) 2^51) by operations on doubles alone, as no machine before AVX-512 turns several
// into integers of 64 bits at once: a sum with 2^52 has the whole number in its lower bits, rounded
// to the nearest one. Where a difference overflows, or z is 0, the position is wrong: the last or
// the middle one.
RONDEL_ALWAYS_INLINE inline std::uint64_t position_of(double ratio) {
  constexpr double shift = 0x1p52;  // position_bits
  constexpr double last = shift - 1;
  const double p = (ratio + 1) * 0x1p51;  // position_bits - 1
  const double cut = choose(mask(p < last), p, last);
  const double nearest = cut + shift;
  return std::bit_cast<std::uint64_t>(nearest) + mask(cut < nearest - shift) -
         std::bit_cast<std::uint64_t>(shift);
}

// Whether rounding may have changed the upper bits, from min_bit on.
bool is_doubtful(std::uint64_t position) {
  constexpr std::uint64_t lower_bits = (std::uint64_t{1} << min_bit) - 1;
  return ((position + position_rounding) & lower_bits) < 2 * position_rounding;
}

constexpr std::size_t batch = 128;  // coordinates found at once

// The model of all sites is made at one question in so many sites.
constexpr Index many = 128;

// side_over_tangent() is asked until it has failed this much more often than not.
constexpr std::uint64_t max_ties = 16;

}  // namespace

template <models::SphereModel T>
void SquareSites<T>::assign(const Input& input, const GivenSites<T>& given, Index first,
                            Index num_sites, const SquareCoordinates& coordinates) {
  points_ = coordinates.points;
  positions_ = coordinates.positions;
  given_ = &given;
  sites_ = input.sites;
  order_ = input.order;
  copies_ = input.copies;
  first_ = first;
  num_sites_ = num_sites;
  next_ = first;
  extent_ = input.extent;
  bits_ = -1;
  num_unsure_ = 0;
  num_ties_ = 0;
  num_over_tangent_ = 0;
  tally_ = {};
  all_.assign({}, {}, center());
}

template <models::SphereModel T>
void SquareSites<T>::find_bounds(int bits) {
  bits_ = bits;
  if (is_weighted) {
    // w is off by at most 2 units; it is below sqrt(3) s/|p|.
    const double max_w = 1.74 * extent_.max_size / extent_.min_size;
    square_bound_ = find_weighted_bound(2.1 * max_w, max_w);
    cube_bound_ = 0;
  } else {
    // In units: 71 length^2 for the error of w, 39 for those of u and v, 34 length for roundings;
    // half of the last two more for terms of higher order (docs/theory/blocks.md).
    const double length = std::ldexp(1, bits + 1 - order::position_bits);
    square_bound_ = 81 * unit_roundoff * (length * length);
    cube_bound_ = 1.5 * (39 + 34 * length) * unit_roundoff;
  }
  double part = std::ldexp(1, 1 - order::position_bits);
  for (int i = 0; i <= bits; ++i) {
    limits_[static_cast<std::size_t>(i)] = limits(part);
    part *= 2;
  }
}

template <models::SphereModel T>
void SquareSites<T>::read_sites(std::size_t first, std::size_t end, std::span<Point> sites) const {
  if (!copies_.is_empty()) return copies_.get(first, sites);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const std::size_t later = first + i + system::prefetch_distance;
    if (later < end) system::prefetch(&sites_[order_[later]]);
    sites[i] = sites_[order_[first + i]];
  }
}

template <models::SphereModel T>
void SquareSites<T>::enter(const Square& square, Index num_sites) {
  if (bits_ != square.bits) find_bounds(square.bits);
  const order::CubeAxes axes = order::cube_axes(square.corner.face);
  const auto u_axis = exact::to_vector(axes.u);
  const auto v_axis = exact::to_vector(axes.v);
  const auto out = exact::to_vector(axes.out);
  const double hand = det(u_axis, v_axis, out);
  hand_ = hand;
  const double max_size = extent_.max_size;
  const Tangent tangent(square, hand);
  const auto origin = exact::to_vector(center());
  const std::size_t end = std::size_t{next_} + num_sites;
  doubtful_.clear();
  std::array<Point, batch> some;
  for (std::size_t first = next_; first < end; first += batch) {
    const std::span sites(some.data(), std::min(batch, end - first));
    read_sites(first, end, sites);
    SquarePoint* const point = points_ + first;
    SquarePosition* const position = positions_ + first;
    system::with_wide_vectors([=]() RONDEL_ALWAYS_INLINE {
      for (std::size_t i = 0; i < sites.size(); ++i) {
        const double x = sites[i].x - origin.x;
        const double y = sites[i].y - origin.y;
        const double z = sites[i].z - origin.z;
        // A product with an axis picks a coordinate, exactly.
        const double depth = x * out.x + y * out.y + z * out.z;
        const double u = (x * u_axis.x + y * u_axis.y + z * u_axis.z) / depth;
        const double v = (x * v_axis.x + y * v_axis.y + z * v_axis.z) / depth;
        const double size = is_weighted ? max_size / depth : std::sqrt(1 + (u * u + v * v));
        const double w = is_weighted ? size : tangent.height(u, hand * v, size);
        point[i] = {u, hand * v, w, size};
        position[i] = {position_of(u), position_of(v)};
      }
    });
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (is_doubtful(position[i].u) || is_doubtful(position[i].v))
        doubtful_.push_back(static_cast<Index>(first + i));
    }
  }
  next_ += num_sites;
}

// With weights w is sqrt(1 + u^2 + v^2) s/|p|, and the change of the root is at most that of
// (u, v).
template <models::SphereModel T>
SquareLimits SquareSites<T>::limits(double length) const {
  double distance = 1.42 * length;
  if (is_weighted) {
    const double max_ratio = extent_.max_size / extent_.min_size;
    distance = max_ratio * 2.01 * length + 1.74 * (max_ratio - 1);
  }
  return {std::max(orientation_bound * distance, min_bound),
          std::max(conflict_limit(distance), min_bound)};
}

template <models::SphereModel T>
Sign SquareSites<T>::orientation(Index a, Index b, Index c) const {
  return predicates::orientation(point(a), point(b), point(c), center()).sign;
}

// The value is the volume of three steps, positive if the third one leads above the plane of the
// others, seen from the side from which they are in counterclockwise order.
template <models::SphereModel T>
Sign SquareSites<T>::side_over_tangent(Index a, Index b, Index c, Index p) const {
  // The error: for places, times w; for heights and roundings.
  constexpr double cube_bound = 1.5 * 68 * unit_roundoff;
  constexpr double bound_of_rest = 256 * unit_roundoff;
  const TangentStep x(points_[a], points_[b]);
  const TangentStep y(points_[a], points_[c]);
  const TangentStep z(points_[a], points_[p]);
  const double value = x.height * (y.u * z.v - y.v * z.u) + y.height * (z.u * x.v - z.v * x.u) +
                       z.height * (x.u * y.v - x.v * y.u);
  const double squared = std::max(std::max(x.squared, y.squared), z.squared);
  const double bound = (cube_bound * std::sqrt(squared) + bound_of_rest * squared) * squared;
  return beyond(value, std::max(bound, min_bound));
}

template <models::SphereModel T>
Sign SquareSites<T>::filtered_side(Index a, Index b, Index c, Index p) {
  if constexpr (is_weighted) {
    const Vector ab = coordinates(b) - coordinates(a);
    const Vector ac = coordinates(c) - coordinates(a);
    const Vector ap = coordinates(p) - coordinates(a);
    const double distance = std::sqrt(std::max({dot(ab, ab), dot(ac, ac), dot(ap, ap)}));
    return -beyond(dot(cross(ab, ac), ap), std::max(conflict_limit(distance), min_bound));
  }
  if (num_ties_ > max_ties * (num_over_tangent_ + 1)) return Sign::zero;
  const Sign side = side_over_tangent(a, b, c, p);
  ++(side == Sign::zero ? num_ties_ : num_over_tangent_);
  return -side;
}

// The ladder asks the sites as they are given few questions, and for many the model of all sites,
// which remembers.
template <models::SphereModel T>
bool SquareSites<T>::is_in_conflict(Index a, Index b, Index c, Index p) {
  const Sign sign = filtered_side(a, b, c, p);
  if (sign != Sign::zero) {
    count_filtered();
    return sign == Sign::positive;
  }
  predicates::Decision decision;
  if (num_unsure_ <= num_sites_ / many) ++num_unsure_;
  if (num_unsure_ <= num_sites_ / many) {
    decision = predicates::conflict_above_filter(*given_, a, b, c, p);
  } else {
    if (all_.size() == 0) all_.assign(sites_, order_.subspan(first_, num_sites_), center());
    decision =
        predicates::conflict_above_filter(all_, a - first_, b - first_, c - first_, p - first_);
  }
  count(tally_, decision.rung);
  return decision.sign == Sign::positive;
}

template class SquareSites<models::ProjectedPoints>;
template class SquareSites<models::WeightedPoints>;

}  // namespace rondel::bulk
