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
//
// These are the rungs; conflict.h composes them.
#pragma once

#include <array>
#include <optional>

#include "predicates/rung.h"

namespace rondel::predicates {

// Inline wherever it is asked: a call would cost the builds of weighted sites a tenth.
[[gnu::always_inline]] inline Sign side_of_plane_filter(const Vector& b, const Vector& c,
                                                        const Vector& d, const Vector& p) {
  const Vector pb = b - p;
  const Vector pc = c - p;
  const Vector pd = d - p;
  const double value = -det(pb, pc, pd);
  return unless_unsure(value, is_beyond(value, plane_bound, dot(pb, pb), dot(pc, pc), dot(pd, pd)));
}

// Where integers of the machine can tell, as among sites of a mesh: ties, too.
std::optional<Sign> side_of_plane_integers_exact(const Quad& q);

// The four points in an even permutation, of which the last one, from which the rungs take the
// differences, is the best for that: so the filter decides when sites of very different weights
// meet.
Quad with_best_origin(const Quad& q);

// The differences b-p, c-p and d-p, exactly, each multiplied by a power of two that makes its
// length about 1.
struct PlaneSteps {
  exact::Vector3<exact::DoubleDouble> b;
  exact::Vector3<exact::DoubleDouble> c;
  exact::Vector3<exact::DoubleDouble> d;
};
PlaneSteps scaled_steps(const Quad& q);

// The filter for differences of any size.
Sign side_of_plane_scaled_filter(const PlaneSteps& steps);

Sign side_of_plane_double_double(const PlaneSteps& steps);

// Never unsure: zero is a tie.
Sign side_of_plane_exact(const Quad& q);

}  // namespace rondel::predicates
