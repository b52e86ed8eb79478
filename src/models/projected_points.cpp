// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "models/projected_points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <new>
#include <utility>

#include "exact/unit_vectors.h"
#include "models/sphere_traits.h"
#include "predicates/orientation.h"
#include "predicates/perturbation.h"
#include "system/huge_pages.h"
#include "system/prefetch.h"

namespace rondel::models {
namespace {

static_assert(SphereTraits<ProjectedPoints>);

using predicates::Vector;

// Low parts that are not known yet are zero. The negative zero is not.
bool is_known(const Point& low) {
  const auto bits = std::bit_cast<std::array<std::uint64_t, 3>>(low);
  return (bits[0] | bits[1] | bits[2]) != 0;
}

// What `high` lacks of u.
Point low_part(const Vector& high, const exact::SplitPoint& u) {
  const Point low = {(u.hi.x - high.x) + u.lo.x, (u.hi.y - high.y) + u.lo.y,
                     (u.hi.z - high.z) + u.lo.z};
  return is_known(low) ? low : Point{-0.0, 0, 0};
}

}  // namespace

// bounds.h counts the roundings.
Vector direction(const Point& p, const Point& center) {
  const Vector v = exact::to_vector(p) - exact::to_vector(center);
  const double squared_length = dot(v, v);
  if (!(squared_length > 0x1p-600 && squared_length < 0x1p600)) {
    return exact::to_vector(exact::unit_vector(p, center).hi);
  }
  const double length = std::sqrt(squared_length);
  return {v.x / length, v.y / length, v.z / length};
}

void ProjectedPoints::assign(std::span<const Point> input, std::span<const Index> order,
                             const Point& center) {
  input_ = input;
  order_ = order;
  center_ = center;
  directions_.clear();
  system::reserve_large(directions_, order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + system::prefetch_distance < order.size()) {
      system::prefetch(&input[order[i + system::prefetch_distance]]);
    }
    directions_.push_back(direction(input[order[i]], center));
  }
  low_parts_ = {};
  num_low_parts_ = 0;
  tally_ = {};
}

void ProjectedPoints::set(Index a, std::span<const Point> input, std::span<const Index> order) {
  const predicates::Vector v = direction(input[order[a]], center_);
  if (a < directions_.size()) {
    directions_[a] = v;
  } else {
    directions_.push_back(v);
  }
  rebind(input, order);
  if (a < low_parts_.size) low_parts_.data[a] = {};
}

Sign ProjectedPoints::orientation(Index a, Index b, Index c) const {
  const Sign sign = predicates::orientation_filter(directions_[a], directions_[b], directions_[c]);
  if (sign != Sign::zero) return sign;
  return predicates::orientation_ladder(point(a), point(b), point(c), center_).sign;
}

void ProjectedPoints::reserve_low_parts() const {
  const std::size_t size = directions_.capacity();
  LowParts longer{
      std::unique_ptr<Point[], Free>(static_cast<Point*>(std::calloc(size, sizeof(Point)))), size};
  if (!longer.data) throw std::bad_alloc();
  std::copy_n(low_parts_.data.get(), low_parts_.size, longer.data.get());
  low_parts_ = std::move(longer);
}

void ProjectedPoints::find_low_parts() const {
  constexpr std::size_t some = 256;
  std::array<exact::SplitPoint, some> units;
  for (std::size_t begin = 0; begin < directions_.size(); begin += some) {
    const std::size_t count = std::min(some, directions_.size() - begin);
    exact::unit_vectors(input_, order_.subspan(begin, count), center_, units.data());
    for (std::size_t i = 0; i < count; ++i)
      low_parts_.data[begin + i] = low_part(directions_[begin + i], units[i]);
  }
}

// Alone, until that was done for one of so many sites: then for all, a quarter of the time each.
void ProjectedPoints::find_low_part(Index a) const {
  constexpr Index many = 32;
  if (directions_.size() > low_parts_.size) reserve_low_parts();
  if (++num_low_parts_ == size() / many) return find_low_parts();
  low_parts_.data[a] = low_part(directions_[a], exact::unit_vector(point(a), center_));
}

[[gnu::always_inline]] inline exact::SplitPoint ProjectedPoints::split_direction(Index a) const {
  if (a >= low_parts_.size || !is_known(low_parts_.data[a])) find_low_part(a);
  return {to_point(directions_[a]), low_parts_.data[a]};
}

bool ProjectedPoints::climb(Index a, Index b, Index c, Index p) const {
  const exact::SplitPoint u = split_direction(a);
  const exact::SplitPoint v = split_direction(b);
  const exact::SplitPoint w = split_direction(c);
  const exact::SplitPoint x = split_direction(p);
  Sign sign = predicates::side_of_circle_extended(u, v, w, x);
  if (sign == Sign::zero) sign = predicates::side_of_circle_double_double(u, v, w, x);
  if (sign == Sign::zero) {
    sign = predicates::side_of_circle_close(point(a), point(b), point(c), point(p), center_);
  }
  if (sign != Sign::zero) {
    ++tally_.double_double;
    return sign == Sign::positive;
  }
  sign = predicates::side_of_circle_exact(point(a), point(b), point(c), point(p), center_);
  if (sign != Sign::zero) {
    ++tally_.exact;
    return sign == Sign::positive;
  }
  ++tally_.perturbed;
  return predicates::is_in_conflict_perturbed(point(a), point(b), point(c), point(p),
                                              Model::projected, center_);
}

}  // namespace rondel::models
