// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Barycentric weights in the plane of a face, seen from the center (Renka, ACM TOMS 23, 1997,
// INTRC0): the ray of u meets the plane of the face (a, b, c) in the point sum of l_i x_i with
//
//     l_a : l_b : l_c = det(u, b, c) : det(u, c, a) : det(u, a, b),   sum 1.
//
// With the steps A = a - u, B = b - u, C = c - u, det(u, b, c) = u.(B x C) has rounding errors of a
// few units of |B||C|, whatever the size of the face. Where doubles do not suffice, DoubleDouble
// and then arbitrary precision take over. On an edge the limit is l_a : l_b = |u x B| : |u x A|.
//
// in    targets with their locations
// out   rows of two or three weights, sum 1
// index spatial ranks of vertices
#pragma once

#include <array>

#include "exact/vector.h"
#include "interpolation/prepared_triangulation.h"
#include "interpolation/row.h"

namespace rondel::interpolation {

using Vec = exact::Vector3<double>;
using Weights3 = std::array<double, 3>;

// Steps between split unit vectors that are shorter than this are not accurate to doubles.
inline constexpr double min_split_step = 0x1p-45;

// Returns x - u. Each coordinate is accurate to a few units in the last place of the step if that
// is no shorter than min_split_step.
inline Vec step(const exact::SplitPoint& u, const exact::SplitPoint& x) {
  return {(x.hi.x - u.hi.x) + (x.lo.x - u.lo.x), (x.hi.y - u.hi.y) + (x.lo.y - u.lo.y),
          (x.hi.z - u.hi.z) + (x.lo.z - u.lo.z)};
}
// True if the step is long enough for step() to be accurate.
inline bool is_split_enough(const Vec& step) {
  return dot(step, step) >= min_split_step * min_split_step;
}

// Returns the step from the target to a vertex in another place, accurate to a few units in the
// last place for any length above 2^-1022.
Vec exact_step(const PreparedTriangulation& prepared, const LocatedTarget& place, Index vertex);
// Returns the same step as exact_step(), by doubles where these suffice.
inline Vec careful_step(const PreparedTriangulation& prepared, const LocatedTarget& place,
                        Index vertex) {
  const Vec split = step(place.unit, prepared.unit(vertex));
  return is_split_enough(split) ? split : exact_step(prepared, place, vertex);
}

// Adds the two weights of a target on an edge, in any dimension.
void weigh_on_edge(const PreparedTriangulation& prepared, const LocatedTarget& place, Row& row);

class LinearKernel {
 public:
  explicit LinearKernel(const PreparedTriangulation& prepared) : prepared_(prepared) {}
  void operator()(const LocatedTarget& place, Row& row) const;

 private:
  [[nodiscard]] Weights3 careful_weights(const LocatedTarget& place, const Triple& corners,
                                         double largest_step_squared) const;

  const PreparedTriangulation& prepared_;
};

}  // namespace rondel::interpolation
