// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts that tests of the overlay share: sets of cells, and areas of pieces by clipping one cell
// by another.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/remap.h"
#include "support/generators.h"
#include "support/random.h"

namespace rondel::test {

inline constexpr double ulp = 0x1p-52;

struct LongVector {
  long double x;
  long double y;
  long double z;
};
inline LongVector long_vector(const Point& p) { return {p.x, p.y, p.z}; }
inline LongVector cross_of(const LongVector& a, const LongVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline long double dot_of(const LongVector& a, const LongVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline LongVector unit_of(const LongVector& a) {
  const long double length = std::sqrt(dot_of(a, a));
  return {a.x / length, a.y / length, a.z / length};
}

using LongRing = std::vector<LongVector>;

// Sutherland and Hodgman's: what of a convex ring is left of the great circle from a to b.
inline LongRing clipped(const LongRing& ring, const LongVector& a, const LongVector& b) {
  const LongVector normal = cross_of(a, b);
  LongRing result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const LongVector& p = ring[i];
    const LongVector& q = ring[(i + 1) % ring.size()];
    const long double at_p = dot_of(normal, p);
    const long double at_q = dot_of(normal, q);
    if (at_p >= 0) result.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      const long double t = at_p / (at_p - at_q);
      result.push_back(
          unit_of({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.z + t * (q.z - p.z)}));
    }
  }
  return result;
}

// The sum of the interior angles' excess would cancel; triangles around the middle do not.
inline long double area_of(const LongRing& ring) {
  if (ring.size() < 3) return 0;
  LongVector middle{};
  for (const LongVector& p : ring) middle = {middle.x + p.x, middle.y + p.y, middle.z + p.z};
  middle = unit_of(middle);
  long double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const LongVector& p = ring[i];
    const LongVector& q = ring[(i + 1) % ring.size()];
    const long double volume = dot_of(middle, cross_of(p, q));
    sum += 2 * std::atan2(volume, 1 + dot_of(middle, p) + dot_of(p, q) + dot_of(q, middle));
  }
  return sum;
}

inline LongRing ring_of(const Cells& cells, std::size_t i) {
  LongRing ring;
  for (const Index k : cells.rings[i]) ring.push_back(long_vector(cells.points[k]));
  return ring;
}

// The mean of x over convex cells.
inline std::vector<LongVector> centers_of(const Triangulation& sites) {
  const Cells all = cells(sites);
  std::vector<LongVector> centers;
  for (std::size_t i = 0; i < sites.num_sites(); ++i) {
    const LongRing ring = ring_of(all, i);
    LongVector moment{};
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const LongVector n = cross_of(ring[k], ring[(k + 1) % ring.size()]);
      const long double sine = std::sqrt(dot_of(n, n));
      const long double half =
          std::atan2(sine, dot_of(ring[k], ring[(k + 1) % ring.size()])) / (2 * sine);
      moment = {moment.x + half * n.x, moment.y + half * n.y, moment.z + half * n.z};
    }
    const long double area = area_of(ring);
    centers.push_back({moment.x / area, moment.y / area, moment.z / area});
  }
  return centers;
}

// What of a ring within a hemisphere is in a convex cell.
inline long double area_of_piece(LongRing ring, const Cells& second, std::size_t j) {
  const LongRing other = ring_of(second, j);
  for (std::size_t k = 0; k < other.size() && ring.size() > 2; ++k) {
    ring = clipped(ring, other[k], other[(k + 1) % other.size()]);
  }
  return area_of(ring);
}

// Of convex cells.
inline long double area_of_piece(const Cells& first, std::size_t i, const Cells& second,
                                 std::size_t j) {
  return area_of_piece(ring_of(first, i), second, j);
}

inline Triangulation triangulation_of(std::string_view kind, std::size_t n, std::uint64_t seed) {
  const SiteSet set = generator(kind).make(n, seed);
  return delaunay(set.sites, {.sphere = set.sphere});
}

// The area of piece (source i, target j).
inline double piece_of(const Remap& remap, std::size_t i, std::size_t j) {
  for (std::uint64_t k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k) {
    if (remap.pieces.values[k] == i) return remap.areas[k];
  }
  return 0;
}

// A group for each cell; with gaps some are in none.
inline std::vector<Index> random_groups(std::size_t n, Index num_groups, std::uint64_t seed,
                                        bool has_gaps = false) {
  Random random(seed);
  std::vector<Index> groups(n);
  for (Index& group : groups) {
    group = static_cast<Index>(random.below(num_groups + (has_gaps ? 1U : 0U)));
    if (group == num_groups) group = no_index;
  }
  return groups;
}

}  // namespace rondel::test
