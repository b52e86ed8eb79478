// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "models/weighted_points.h"

#include "models/sphere_traits.h"
#include "predicates/orientation.h"
#include "predicates/perturbation.h"
#include "system/huge_pages.h"

namespace rondel::models {

static_assert(SphereTraits<WeightedPoints>);

void WeightedPoints::assign(std::span<const Point> input, std::span<const Index> order,
                            const Point& center) {
  center_ = exact::to_vector(center);
  points_.clear();
  system::reserve_large(points_, order.size());
  for (const Index i : order) points_.push_back(exact::to_vector(input[i]));
  tally_ = {};
}

void WeightedPoints::set(Index a, std::span<const Point> input, std::span<const Index> order) {
  const predicates::Vector v = exact::to_vector(input[order[a]]);
  if (a < points_.size()) {
    points_[a] = v;
  } else {
    points_.push_back(v);
  }
}

Sign WeightedPoints::orientation(Index a, Index b, Index c) const {
  return predicates::orientation_ladder(point(a), point(b), point(c),
                                        {center_.x, center_.y, center_.z})
      .sign;
}

bool WeightedPoints::climb(Index a, Index b, Index c, Index p) const {
  const auto decision = predicates::side_of_plane_ladder(point(a), point(b), point(c), point(p));
  if (decision.sign != Sign::zero) {
    count(tally_, decision.rung);
    return decision.sign == Sign::positive;
  }
  ++tally_.perturbed;
  return predicates::is_in_conflict_perturbed(point(a), point(b), point(c), point(p),
                                              Model::weighted, {center_.x, center_.y, center_.z});
}

}  // namespace rondel::models
