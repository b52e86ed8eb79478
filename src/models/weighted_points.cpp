// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "models/weighted_points.h"

#include <algorithm>
#include <span>

#include "models/moved_sites.h"
#include "models/sphere_traits.h"
#include "system/large_arrays.h"

namespace rondel::models {

static_assert(MovingSphereModel<WeightedPoints>);

void WeightedPoints::assign(std::span<const Point> input, std::span<const Index> order,
                            const Point& center) {
  center_ = exact::to_vector(center);
  points_.clear();
  system::reserve_large(points_, order.size());
  for (const Index i : order) points_.push_back(exact::to_vector(input[i]));
}

void WeightedPoints::set(Index a, std::span<const Point> input, std::span<const Index> order) {
  const predicates::Vector v = exact::to_vector(input[order[a]]);
  if (a < points_.size()) {
    points_[a] = v;
  } else {
    points_.push_back(v);
  }
}

double WeightedPoints::move_all(std::span<const Point> input, std::span<const Index> order,
                                std::span<const Index> in_use, unsigned threads) {
  return replace_all(points_, input, order, in_use, threads,
                     [](std::span<const Point> points, predicates::Vector* forms) {
                       std::ranges::transform(points, forms, exact::to_vector);
                     });
}

}  // namespace rondel::models
