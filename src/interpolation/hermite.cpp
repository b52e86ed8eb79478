// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/hermite.h"

#include <algorithm>
#include <cmath>

#include "interpolation/linear.h"
#include "interpolation/normalize_weights.h"
#include "interpolation/rows.h"

namespace rondel::interpolation {

bool HermiteKernel::all_have_gradients() const {
  return has_gradient_.empty() || std::ranges::all_of(flat_, [this](const WeightedVertex& share) {
           return has_gradient_[share.vertex] != 0;
         });
}

// Weighs two sites on one line through u by their distances in the stereographic plane,
// s| / (1 - |s|^2 / 4)^(1/2).
void HermiteKernel::weigh_on_contour(const LocatedTarget& place) {
  const auto distance = [&](Index v) {
    const Vec s = careful_step(prepared_, place, v);
    return norm(s) / std::sqrt(1 - dot(s, s) / 4);
  };
  const double first = distance(flat_[0].vertex);
  const double second = distance(flat_[1].vertex);
  flat_[0].weight = second / (first + second);
  flat_[1].weight = first / (first + second);
}

void HermiteKernel::add_without_gradients(const LocatedTarget& place, GradientRow& row) {
  flat_.clear();
  sibson_(place, flat_);
  if (normalization_ == Normalization::homogeneous) make_homogeneous(prepared_, place.unit, flat_);
  for (const auto& [v, weight] : flat_) row.push_back({v, weight, {}});
}

void HermiteKernel::operator()(const LocatedTarget& place, GradientRow& row) {
  flat_.clear();
  planar_(place, flat_);
  if (!all_have_gradients()) {
    add_without_gradients(place, row);
    return;
  }
  if (flat_.size() == 2) weigh_on_contour(place);
  take_up_rounding(flat_);
  for (const auto& [v, weight] : flat_) {
    // u = x - s, whose component along x is 1 - |s|^2 / 2.
    const Vec s = careful_step(prepared_, place, v);
    const double square = dot(s, s);
    const Vec tangent = square / 2 * exact::to_vector(prepared_.unit(v).hi) - s;
    row.push_back({v, weight, exact::to_point(weight / (2 - square / 2) * tangent)});
  }
}

}  // namespace rondel::interpolation
