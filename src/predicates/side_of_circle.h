// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The conflict test of the projected model (the paper, section 4.1): whether p lies
// inside the circle of the face (b, c, d), all four being exact projections on the
// sphere. With unit vectors and B = b-p, C = c-p, D = d-p, p.B = -|B|^2 / 2, hence
//
//     -2 det(B,C,D) = |B|^2 det(p,C,D) + |C|^2 det(p,D,B) + |D|^2 det(p,B,C):
//
// the planar in-circle test in a sheared tangent frame of p.
//
// 1. Positive: in conflict. Zero: the four projections are cocircular.
// 2. Odd under exchange of two arguments.
// 3. Unchanged when a point moves along its ray.
//
// These are the rungs; conflict.h composes them. Filter: the left side in doubles, which decides
// while the sites are not close, then the right side in doubles, whose error is of order u H^3
// against a value of order H^4 at any distance H. Extended: the right side with 64 bits, from split
// unit vectors. Double-double: the left side. Close: the right side in doubles from differences of
// the points as given, whose error is of order u H^4. Wide filter: rays with coordinates of all
// magnitudes. Exact: balls of more and more words; the sign
// of a sum of four square roots in integers.
#pragma once

#include <optional>

#include "exact/unit_vector.h"
#include "predicates/rung.h"

namespace rondel::predicates {

// For directions within `direction_error` of unit vectors.
// Inline wherever it is asked: a call would cost builds some hundredths.
[[gnu::always_inline]] inline Sign side_of_circle_filter(const Vector& b, const Vector& c,
                                                         const Vector& d, const Vector& p) {
  const Vector pb = b - p;
  const Vector pc = c - p;
  const Vector pd = d - p;
  const Vector cd = cross(pc, pd);
  const double b2 = dot(pb, pb);
  const double c2 = dot(pc, pc);
  const double d2 = dot(pd, pd);
  const double plain = -dot(pb, cd);
  if (is_beyond_longest(plain, circle_plane_bound, b2, c2, d2)) return sign_of(plain);

  const Vector db = cross(pd, pb);
  const Vector bc = cross(pb, pc);
  const Vector sheared = {b2 * cd.x + c2 * db.x + d2 * bc.x, b2 * cd.y + c2 * db.y + d2 * bc.y,
                          b2 * cd.z + c2 * db.z + d2 * bc.z};
  const double value = dot(p, sheared);
  const double m = std::max(std::max(b2, c2), d2);
  constexpr double bound = circle_bound * circle_bound;
  return unless_unsure(value, value * value > bound * (m * m * m));
}

// The first try of this filter for one face (b, c, d) and several p, or zero: by differences from b
// instead of from p, as the test is odd under their exchange. `normal` is cross(c-b, d-b), and c2 and
// d2 are the squares of their lengths.
inline Sign sure_side_of_face(const Vector& b, const Vector& normal, double c2, double d2,
                              const Vector& p) {
  const Vector bp = p - b;
  const double plain = dot(bp, normal);
  return unless_unsure(plain, is_beyond_longest(plain, circle_plane_bound, dot(bp, bp), c2, d2));
}

// Unsure of everything where the processor has no numbers of 64 bits. Decides what the roundings of
// coordinates leave of ties. The unit vectors must be within 2^-100 of the exact ones.
Sign side_of_circle_extended(const exact::SplitPoint& b, const exact::SplitPoint& c,
                             const exact::SplitPoint& d, const exact::SplitPoint& p);

// For unit vectors within 2^-100 of the exact ones.
Sign side_of_circle_double_double(const exact::SplitPoint& b, const exact::SplitPoint& c,
                                  const exact::SplitPoint& d, const exact::SplitPoint& p);

// For points as given, however close: in doubles, from differences of the points and not of their
// directions (side_of_circle_close.cpp).
Sign side_of_circle_close(const Quad& q, const Point& center);

// For points as given, with coordinates of different magnitudes: in doubles with exponents of their own
// (side_of_circle_wide.cpp).
Sign side_of_circle_wide_filter(const Quad& q, const Point& center);

// Whether numbers of 64 bits may tell differences of unit vectors: side_of_circle_extended is unsure
// of sites that are all closer.
inline bool are_apart(const exact::SplitPoint& a, const exact::SplitPoint& b) {
  constexpr double close = 0x1p-37;
  return std::abs(a.hi.x - b.hi.x) > close || std::abs(a.hi.y - b.hi.y) > close ||
         std::abs(a.hi.z - b.hi.z) > close;
}

// For points as given, where integers of the machine can tell: so they can if it is a tie of points
// none of whose coordinates is much smaller than another.
std::optional<Sign> side_of_circle_integers_exact(const Quad& q, const Point& center);

// For points as given. Never unsure: zero is a tie.
Sign side_of_circle_exact(const Quad& q, const Point& center);

}  // namespace rondel::predicates
