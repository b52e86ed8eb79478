// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dual/split_sites.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "blocks/prefetch.h"
#include "dual/exact_normal.h"
#include "rondel/error.h"
#include "system/parallel.h"

namespace rondel::dual {

using blocks::prefetch;
using blocks::prefetch_distance;
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

exact::SplitPoint scaled_place(const Point& p, int shift) {
  return {{std::ldexp(p.x, shift), std::ldexp(p.y, shift), std::ldexp(p.z, shift)}, {}};
}

}  // namespace

void check_size(const Triangulation& triangulation, std::size_t num_sites) {
  if (num_sites == triangulation.num_sites()) return;
  throw InvalidInput("the triangulation was made from " +
                         std::to_string(triangulation.num_sites()) + " sites, not from " +
                         std::to_string(num_sites),
                     std::min(num_sites, triangulation.num_sites()));
}

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
  set_order(triangulation);
  set_places(triangulation.report().threads);
}

void SplitSites::set_order(const Triangulation& triangulation) {
  const auto faces = triangulation.faces();
  std::vector<Index> rank(sites_.size(), no_index);
  order_.reserve(triangulation.num_vertices());
  corners_ = std::make_unique_for_overwrite<Triple[]>(faces.size());
  const auto rank_of = [&](Index v) {
    if (rank[v] == no_index) {
      rank[v] = static_cast<Index>(order_.size());
      order_.push_back(v);
    }
    return rank[v];
  };
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (f + prefetch_distance < faces.size()) {
      for (const Index v : faces[f + prefetch_distance]) prefetch(&rank[v]);
    }
    for (std::size_t i = 0; i < 3; ++i) corners_[f][i] = rank_of(faces[f][i]);
  }
  for (const Index v : triangulation.ring()) rank_of(v);
}

void SplitSites::set_places(unsigned threads) {
  places_ = std::make_unique_for_overwrite<exact::SplitPoint[]>(order_.size());
  const bool project = is_projected();
  const int shift = project ? 0 : scale_exponent(sites_);
  system::parallel_for(
      threads, order_.size(), parallel_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          if (k + prefetch_distance < end) prefetch(&sites_[order_[k + prefetch_distance]]);
          const Point& p = sites_[order_[k]];
          places_[k] = project ? exact::unit_vector(p, center_) : scaled_place(p, shift);
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
  const auto exact = exact_projected_difference(point(a), point(b), center_);
  return exact.length * exact.direction;
}

Vec SplitSites::direction(Index a, Index b) const {
  const Offset d = offset(a, b);
  const Vec v = d.hi + d.lo;
  if (is_rounded_enough(v)) return normalized(v);
  return is_projected() ? exact_projected_difference(point(a), point(b), center_).direction
                        : exact_direction(point(a), point(b));
}

}  // namespace rondel::dual
