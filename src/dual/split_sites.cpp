// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dual/split_sites.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "blocks/parallel.h"
#include "dual/exact_normal.h"
#include "rondel/error.h"

namespace rondel::dual {
namespace {

// The power of two that brings the largest coordinate to [1/2, 1).
int scale_exponent(std::span<const Point> sites) {
  double largest = 0;
  for (const Point& p : sites) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  return -exponent;
}

void check_size(const Triangulation& triangulation, std::size_t num_sites) {
  if (num_sites == triangulation.num_sites()) return;
  throw InvalidInput("the triangulation was made from " +
                         std::to_string(triangulation.num_sites()) + " sites, not from " +
                         std::to_string(num_sites),
                     std::min(num_sites, triangulation.num_sites()));
}

}  // namespace

Vec normalized(const Vec& v) {
  const double square = dot(v, v);
  if (square < 0x1p-900) {
    const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (size == 0) return v;
    return normalized({v.x / size, v.y / size, v.z / size});
  }
  const double length = std::sqrt(square);
  return {v.x / length, v.y / length, v.z / length};
}

SplitSites::SplitSites(const Triangulation& triangulation, std::span<const Point> sites)
    : sites_(sites), center_(triangulation.sphere().center), model_(triangulation.model()) {
  check_size(triangulation, sites.size());
  places_.resize(sites.size());
  const int shift = is_projected() ? 0 : scale_exponent(sites);
  const bool project = is_projected();
  blocks::parallel_for(
      0, sites.size(), triangulation.report().threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Point& p = sites[i];
          places_[i] = project ? exact::unit_vector(p, center_)
                               : exact::SplitPoint{{std::ldexp(p.x, shift), std::ldexp(p.y, shift),
                                                    std::ldexp(p.z, shift)},
                                                   {}};
        }
      });
}

// The places of projected sites are wrong by 2^-100 each, so offsets above 2^-45 are right to
// 2^-54. Weighted offsets are exact unless they come near to underflow.
bool SplitSites::is_rounded_enough(const Vec& difference) const {
  return dot(difference, difference) >= (is_projected() ? 0x1p-90 : 0x1p-900);
}

Vec SplitSites::difference(Index a, Index b) const {
  const Offset d = offset(a, b);
  const Vec v = d.hi + d.lo;
  if (!is_projected() || is_rounded_enough(v)) return v;
  const auto exact = exact_projected_difference(sites_[a], sites_[b], center_);
  return exact.length * exact.direction;
}

Vec SplitSites::direction(Index a, Index b) const {
  const Offset d = offset(a, b);
  const Vec v = d.hi + d.lo;
  if (is_rounded_enough(v)) return normalized(v);
  return is_projected() ? exact_projected_difference(sites_[a], sites_[b], center_).direction
                        : exact_direction(sites_[a], sites_[b]);
}

}  // namespace rondel::dual
