// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dual/split_sites.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "dual/face_batch.h"
#include "exact/unit_vector.h"
#include "system/large_arrays.h"
#include "system/parallel.h"
#include "system/prefetch.h"

namespace rondel::dual {

using system::prefetch;
using system::prefetch_distance;
namespace {

// The power of two that brings the largest coordinate to [1/2, 1).
int scale_exponent(std::span<const Point> sites) {
  double largest = 0;
  for (const Point& p : sites) largest = std::max(largest, largest_coordinate(p));
  int exponent = 0;
  std::frexp(largest, &exponent);
  return -exponent;
}

exact::SplitPoint scaled_place(const Point& p, int shift) {
  return {{std::ldexp(p.x, shift), std::ldexp(p.y, shift), std::ldexp(p.z, shift)}, {}};
}

}  // namespace

SplitSites::SplitSites(const Triangulation& triangulation, unsigned threads)
    : sites_(triangulation.sites().points()),
      center_(triangulation.sphere().center),
      model_(triangulation.model()),
      threads_(threads) {
  set_order(triangulation);
  set_places();
}

// Without a branch for new ranks, which would be mispredicted: what belongs to the next new rank is
// written again and again until there is one.
void SplitSites::set_order(const Triangulation& triangulation) {
  const auto faces = triangulation.faces();
  const std::size_t room = triangulation.num_vertices() + 1;
  std::vector<Index> rank(sites_.size(), no_index);
  sites_of_ranks_ = system::make_large_array<Index>(room);
  degrees_ = system::make_large_array<Index>(room);
  first_faces_ = system::make_large_array<Index>(room);
  corners_ = system::make_large_array<Triple>(faces.size());
  Index count = 0;
  const auto rank_of = [&](Index v, Index face) {
    const bool is_new = rank[v] == no_index;
    const Index k = is_new ? count : rank[v];
    rank[v] = k;
    sites_of_ranks_[count] = v;
    first_faces_[count] = face;
    degrees_[count] = 0;
    ++degrees_[k];
    count += static_cast<Index>(is_new);
    return k;
  };
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (f + prefetch_distance < faces.size()) {
      for (const Index v : faces[f + prefetch_distance]) prefetch(&rank[v]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      corners_[f][i] = rank_of(faces[f][i], static_cast<Index>(f));
    }
  }
  for (const Index v : triangulation.ring()) rank_of(v, no_index);
  order_ = {sites_of_ranks_.get(), count};
}

void SplitSites::set_places() {
  places_ = system::make_large_array<exact::SplitPoint>(order_.size());
  const int shift = is_projected() ? 0 : scale_exponent(sites_);
  system::parallel_for(threads_, order_.size(), parallel_grain,
                       [&](std::size_t begin, std::size_t end) {
                         const auto order = order_.subspan(begin, end - begin);
                         if (is_projected()) {
                           exact::unit_vectors(sites_, order, center_, &places_[begin]);
                           return;
                         }
                         for (std::size_t k = begin; k < end; ++k) {
                           places_[k] = scaled_place(sites_[order_[k]], shift);
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
