// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/side_of_plane.h"

#include <array>

#include "exact/exact_sign.h"
#include "predicates/scale.h"

namespace rondel::predicates {
namespace {

using exact::DoubleDouble;

using DifferenceVector = exact::Vector3<DoubleDouble>;

double squared_length(const DifferenceVector& v) {
  return v.x.hi * v.x.hi + v.y.hi * v.y.hi + v.z.hi * v.z.hi;
}

Sign by_double_double(const DifferenceVector& pb, const DifferenceVector& pc,
                      const DifferenceVector& pd) {
  const double value = -det(pb, pc, pd).hi;
  return unless_unsure(value, is_beyond(value, plane_double_double_bound, squared_length(pb),
                                        squared_length(pc), squared_length(pd)));
}

// The filter for differences of any size.
Sign by_scaled_differences(const DifferenceVector& pb, const DifferenceVector& pc,
                           const DifferenceVector& pd) {
  const auto rounded = [](const DifferenceVector& v) { return Vector{v.x.hi, v.y.hi, v.z.hi}; };
  return side_of_plane_filter(rounded(pb), rounded(pc), rounded(pd), {0, 0, 0});
}

DifferenceVector scaled_to_one(const DifferenceVector& v) {
  const double factor = factor_to_one({v.x.hi, v.y.hi, v.z.hi});
  return {{factor * v.x.hi, factor * v.x.lo},
          {factor * v.y.hi, factor * v.y.lo},
          {factor * v.z.hi, factor * v.z.lo}};
}

Decision climb(const Point& b, const Point& c, const Point& d, const Point& p) {
  const DifferenceVector pb = scaled_to_one(exact::difference(b, p));
  const DifferenceVector pc = scaled_to_one(exact::difference(c, p));
  const DifferenceVector pd = scaled_to_one(exact::difference(d, p));
  if (const Sign sign = by_scaled_differences(pb, pc, pd); sign != Sign::zero) {
    return {sign, Rung::filter};
  }
  if (const Sign sign = by_double_double(pb, pc, pd); sign != Sign::zero) {
    return {sign, Rung::double_double};
  }
  return {-exact::sign_of_cubic(
              [&](const auto& step) { return det(step(p, b), step(p, c), step(p, d)); }),
          Rung::exact};
}

}  // namespace

Decision side_of_plane_ladder(const Point& b, const Point& c, const Point& d, const Point& p) {
  const std::array<Point, 4> q = {b, c, d, p};
  const auto [i, j, k, origin] =
      order_for_best_origin({to_vector(b), to_vector(c), to_vector(d), to_vector(p)});
  return climb(q[i], q[j], q[k], q[origin]);
}

}  // namespace rondel::predicates
