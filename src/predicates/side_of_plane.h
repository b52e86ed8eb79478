// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The conflict test of the weighted model (the paper, section 4.2): the power test
// is the orientation of four points in space. With B = b-p, C = c-p, D = d-p:
//
//        c
//       / \      the face (b, c, d), counterclockwise seen from outside;
//      / p \     side_of_plane = -sign det(B, C, D) is positive when
//     d-----b    p lies above it.
//
// 1. Positive: in conflict. Zero: the four points are coplanar.
// 2. Odd under exchange of two arguments.
// 3. Does not depend on the center of the sphere.
#pragma once

#include "predicates/filtered.h"
#include "predicates/tally.h"

namespace rondel::predicates {

inline Sign side_of_plane_filter(const Vector& b, const Vector& c, const Vector& d,
                                 const Vector& p) {
  const Vector pb = b - p;
  const Vector pc = c - p;
  const Vector pd = d - p;
  const double value = -det(pb, pc, pd);
  return unless_unsure(value, is_beyond(value, plane_bound, dot(pb, pb), dot(pc, pc), dot(pd, pd)));
}

// All rungs: the filter again with the differences taken from the point from which they are
// shortest, which decides when sites of very different weights meet, then those above.
Decision side_of_plane_ladder(const Point& b, const Point& c, const Point& d, const Point& p);

}  // namespace rondel::predicates
