// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/side_of_plane.h"

#include <array>

#include "exact/exact_sign.h"
#include "exact/integer_signs.h"
#include "predicates/scale.h"

namespace rondel::predicates {
namespace {

using exact::DoubleDouble;

using DifferenceVector = exact::Vector3<DoubleDouble>;

double squared_length(const DifferenceVector& v) {
  return v.x.hi * v.x.hi + v.y.hi * v.y.hi + v.z.hi * v.z.hi;
}

DifferenceVector scaled_to_one(const DifferenceVector& v) {
  const double factor = factor_to_one({v.x.hi, v.y.hi, v.z.hi});
  return {{factor * v.x.hi, factor * v.x.lo},
          {factor * v.y.hi, factor * v.y.lo},
          {factor * v.z.hi, factor * v.z.lo}};
}

}  // namespace

std::optional<Sign> side_of_plane_integers_exact(const Quad& q) {
  const auto volume = exact::sign_of_volume_in_integers(q[3], q[0], q[1], q[2]);
  return volume ? std::optional(-*volume) : std::nullopt;
}

Quad with_best_origin(const Quad& q) {
  const auto [i, j, k, origin] =
      order_for_best_origin({to_vector(q[0]), to_vector(q[1]), to_vector(q[2]), to_vector(q[3])});
  return {q[i], q[j], q[k], q[origin]};
}

PlaneSteps scaled_steps(const Quad& q) {
  return {scaled_to_one(exact::difference(q[0], q[3])),
          scaled_to_one(exact::difference(q[1], q[3])),
          scaled_to_one(exact::difference(q[2], q[3]))};
}

Sign side_of_plane_scaled_filter(const PlaneSteps& steps) {
  const auto rounded = [](const DifferenceVector& v) { return Vector{v.x.hi, v.y.hi, v.z.hi}; };
  return side_of_plane_filter(rounded(steps.b), rounded(steps.c), rounded(steps.d), {0, 0, 0});
}

Sign side_of_plane_double_double(const PlaneSteps& steps) {
  const double value = -det(steps.b, steps.c, steps.d).hi;
  return unless_unsure(value, is_beyond(value, plane_double_double_bound, squared_length(steps.b),
                                        squared_length(steps.c), squared_length(steps.d)));
}

Sign side_of_plane_exact(const Quad& q) {
  return -exact::sign_of_cubic(
      [&q](const auto& step) { return det(step(q[3], q[0]), step(q[3], q[1]), step(q[3], q[2])); });
}

}  // namespace rondel::predicates
