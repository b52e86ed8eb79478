// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "models/projected_points.h"

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "exact/unit_vector.h"
#include "models/moved_sites.h"
#include "models/sphere_traits.h"
#include "system/large_arrays.h"

namespace rondel::models {
namespace {

static_assert(MovingSphereModel<ProjectedPoints>);

using predicates::Vector;

}  // namespace

void ProjectedPoints::assign(std::span<const Point> input, std::span<const Index> order,
                             const Point& center) {
  center_ = center;
  directions_.clear();
  system::reserve_large(directions_, order.size());
  directions_.resize(order.size());
  move_all(input, order, {}, 1);
}

void ProjectedPoints::set(Index a, std::span<const Point> input, std::span<const Index> order) {
  const predicates::Vector v = predicates::direction(input[order[a]], center_);
  if (a < directions_.size()) {
    directions_[a] = v;
  } else {
    directions_.push_back(v);
  }
  rebind(input, order);
  if (a < low_parts_.size) low_parts_.data[a] = {};
}

double ProjectedPoints::move_all(std::span<const Point> input, std::span<const Index> order,
                                 std::span<const Index> in_use, unsigned threads) {
  rebind(input, order);
  low_parts_ = {};
  num_low_parts_ = 0;
  return replace_all(directions_, input, order, in_use, threads,
                     [this](std::span<const Point> points, Vector* forms) {
                       predicates::directions(points, center_, forms);
                     });
}

// What `high` lacks of u.
Point ProjectedPoints::low_part(const Vector& high, const exact::SplitPoint& u) {
  const Point low = {(u.hi.x - high.x) + u.lo.x, (u.hi.y - high.y) + u.lo.y,
                     (u.hi.z - high.z) + u.lo.z};
  return is_known(low) ? low : Point{-0.0, 0, 0};
}

void ProjectedPoints::reserve_low_parts() {
  const std::size_t size = directions_.capacity();
  LowParts longer{
      std::unique_ptr<Point[], Free>(static_cast<Point*>(std::calloc(size, sizeof(Point)))), size};
  if (!longer.data) throw std::bad_alloc();
  std::copy_n(low_parts_.data.get(), low_parts_.size, longer.data.get());
  low_parts_ = std::move(longer);
}

void ProjectedPoints::find_low_parts() {
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
void ProjectedPoints::find_low_part(Index a) {
  constexpr Index many = 32;
  if (directions_.size() > low_parts_.size) reserve_low_parts();
  if (++num_low_parts_ == size() / many) return find_low_parts();
  low_parts_.data[a] = low_part(directions_[a], exact::unit_vector(point(a), center_));
}

}  // namespace rondel::models
