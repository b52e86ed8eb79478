// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts that tests of interpolation share: cases of every kind, rows, and directions in many
// bits.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/interpolate.h"
#include "support/generators.h"
#include "support/mpfr_oracle.h"
#include "support/query_oracle.h"

namespace rondel::test {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double ulp = 0x1p-53;  // of the numbers below 1

struct InterpolationCase {
  std::string name;
  SiteSet set;
  Triangulation triangulation;
  std::vector<Point> targets;
};

// Calls `work` for each generator, in the projected model.
inline void for_each_interpolation_case(std::size_t n,
                                        const std::function<void(const InterpolationCase&)>& work) {
  Random random(3);
  for (const Generator& generator : generators()) {
    if (generator.weighted_only || (generator.has_long_integers && is_shortened())) continue;
    InterpolationCase c;
    c.name = generator.name;
    c.set = generator.make(generator.has_long_integers ? std::min<std::size_t>(12, n) : n, 5);
    c.triangulation = delaunay(c.set.sites, {.sphere = c.set.sphere});
    c.targets = query_points(c.set.sites, c.set.sphere.center, random);
    work(c);
  }
}

struct WeightRow {
  std::span<const Index> columns;
  std::span<const double> values;
};
inline WeightRow row_of(const Weights& weights, std::size_t r) {
  const std::uint64_t begin = weights.offsets[r];
  const std::uint64_t size = weights.offsets[r + 1] - begin;
  return {std::span(weights.columns).subspan(begin, size),
          std::span(weights.values).subspan(begin, size)};
}

inline RealVector operator-(const RealVector& a, const RealVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline RealVector cross(const RealVector& a, const RealVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Real dot(const RealVector& a, const RealVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline RealVector real_direction(const Point& p, const Point& center) {
  return *normalized(to_real(p) - to_real(center));
}

// The sum of the weights minus 1, and the length of u x (sum of weights times sites).
struct WeightErrors {
  double unity;
  double direction;
};
inline WeightErrors weight_errors(const WeightRow& row, const SiteSet& set, const Point& target) {
  const RealVector u = real_direction(target, set.sphere.center);
  Real all(-1);
  RealVector sum = {Real(0), Real(0), Real(0)};
  for (std::size_t k = 0; k < row.columns.size(); ++k) {
    const Real weight(row.values[k]);
    const RealVector x = real_direction(set.sites[row.columns[k]], set.sphere.center);
    all = all + weight;
    for (std::size_t c = 0; c < 3; ++c) sum[c] = sum[c] + weight * x[c];
  }
  const RealVector off = cross(u, sum);
  return {all.rounded(), sqrt(dot(off, off)).rounded()};
}

}  // namespace rondel::test
