// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The places of the sites to twice double precision, once for all faces and cells.
//
// A face's normal depends on differences of places only, so a place is
//   projected: the unit vector of the site, known to 2^-100;
//   weighted:  the coordinates as given times one power of two that brings the largest
//              to [1/2, 1): exact, unless bits fall below 2^-1074.
// Notation of this folder: a the site or first corner, B = b - a and C = c - a, N = B x C,
// n = N / |N| the circumcenter, u = 2^-53.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "exact/eft.h"
#include "exact/unit_vector.h"
#include "exact/vector.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "system/large_arrays.h"

namespace rondel::dual {

// So many faces or sites are one thread's work at a time.
inline constexpr std::size_t parallel_grain = 4096;

using Vec = exact::Vector3<double>;
using exact::to_vector;

// b - a as the unevaluated sum hi + lo. |lo| <= 2^-51 in the projected model and
// |lo| <= u|hi| in the weighted one.
struct Offset {
  Vec hi;
  Vec lo;
};

inline Offset offset(const exact::SplitPoint& a, const exact::SplitPoint& b) {
  const auto x = exact::two_diff(b.hi.x, a.hi.x);
  const auto y = exact::two_diff(b.hi.y, a.hi.y);
  const auto z = exact::two_diff(b.hi.z, a.hi.z);
  return {{x.hi, y.hi, z.hi},
          {x.lo + (b.lo.x - a.lo.x), y.lo + (b.lo.y - a.lo.y), z.lo + (b.lo.z - a.lo.z)}};
}

// Vertices are named by their rank: the order in which the faces first come to them (below
// dimension 2, the order of the ring). Faces are in spatial order and sites are not, so places by
// rank are near in memory when they are near in space; by site, every corner would miss the caches.
class RONDEL_API SplitSites {
 public:
  // Keeps a reference to the sites of the triangulation. At most so many threads work, here and for
  // what is made of these places.
  SplitSites(const Triangulation& triangulation, unsigned threads);

  // The site of each rank.
  [[nodiscard]] std::span<const Index> order() const { return order_; }
  // How many faces a rank has, and the first of them, in dimension 2.
  [[nodiscard]] Index degree(Index rank) const { return degrees_[rank]; }
  [[nodiscard]] Index first_face(Index rank) const { return first_faces_[rank]; }
  // The ranks of the corners of a face.
  [[nodiscard]] const Triple& corners(Index face) const { return corners_[face]; }

  [[nodiscard]] const exact::SplitPoint& operator[](Index rank) const { return places_[rank]; }
  [[nodiscard]] Offset offset(Index a, Index b) const {
    return dual::offset(places_[a], places_[b]);
  }
  // b - a with every coordinate right to a few u of the length, however close the two are.
  [[nodiscard]] Vec difference(Index a, Index b) const;
  // Its unit vector, also where the difference is below the smallest double.
  [[nodiscard]] Vec direction(Index a, Index b) const;

  [[nodiscard]] unsigned threads() const { return threads_; }
  [[nodiscard]] bool is_projected() const { return model_ == Model::projected; }
  // The input point of a rank, and all input points.
  [[nodiscard]] const Point& point(Index rank) const { return sites_[order_[rank]]; }
  [[nodiscard]] std::span<const Point> sites() const { return sites_; }
  [[nodiscard]] const Point& center() const { return center_; }

 private:
  [[nodiscard]] bool is_rounded_enough(const Vec& difference) const;
  void set_order(const Triangulation& triangulation);
  void set_places();

  std::span<const Index> order_;
  system::LargeArray<Index> sites_of_ranks_;
  system::LargeArray<Index> degrees_;
  system::LargeArray<Index> first_faces_;
  system::LargeArray<Triple> corners_;
  system::LargeArray<exact::SplitPoint> places_;
  std::span<const Point> sites_;
  Point center_;
  Model model_;
  unsigned threads_;
};

// The slow path of the dual: normals and differences from exact integers, rounded once.

struct ExactNormal {
  Point normal;
  bool is_degenerate;  // the three corners are collinear (weighted model only)
};

// The outward unit normal of the face (a, b, c), each coordinate within 2^-53.
//
// Collinear corners span a face only after the perturbation, which raises sites from the
// center: the face then lies in the plane through the center (or, when that is on the
// line too, through the first site that is not), which supports the hull. Its normal
// points away from the sites.
RONDEL_API ExactNormal exact_normal(const SplitSites& sites, Index a, Index b, Index c);

// The difference b/|b| - a/|a| of the projections.
struct ExactDifference {
  Vec direction;  // unit vector, each coordinate within 2^-53
  double length;  // 0 where it is below the smallest double
};
RONDEL_API ExactDifference exact_projected_difference(const Point& a, const Point& b,
                                                      const Point& center);

// The weights, of sum 1, for which the weighted sum of the projections of the corners lies on the ray
// of p, which is within their cone: each within 2^-53 of itself.
RONDEL_API std::array<double, 3> exact_weights(const std::array<Point, 3>& corners, const Point& p,
                                               const Point& center);

// The unit vector from a to b.
Vec exact_direction(const Point& a, const Point& b);

}  // namespace rondel::dual
