// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Error bounds of the filters. docs/theory/filters.md derives each; a test
// recomputes them and searches for violations.
//
// u = 2^-53 is the unit roundoff, eta bounds the distance of a stored direction from
// the exact unit vector, H is the largest distance of p from the face's corners.
#pragma once

namespace rondel::predicates {

inline constexpr double unit_roundoff = 0x1p-53;

// A direction is computed as p / sqrt(x^2 + y^2 + z^2), at most 3.5u + O(u^2) off relatively.
// With a center, the differences add another u.
inline constexpr double direction_error = 4.6 * unit_roundoff;

// det(B, C, D) of differences of exact data, relative to |B||C||D|:
// rounding of the differences 3u, of the determinant 5u times the permanent (at most 2/sqrt(3)).
inline constexpr double plane_bound = 10 * unit_roundoff;

// det(B, C, D) of stored directions, relative to H^2 where H <= 2: 6 eta + 2 * 8.8u = 45.2u,
// times 1.18 for terms of higher order.
inline constexpr double circle_plane_bound = 54 * unit_roundoff;

// |B|^2 det(p,C,D) + ... of stored directions, relative to H^3 where H <= 2:
// 24 eta + 2 * (12u + 3 eta + 38.1u) = 238.2u, times 1.16 for terms of higher order.
inline constexpr double circle_bound = 284 * unit_roundoff;

// det(a, b-a, c-a) of exact data, relative to |a| |b-a| |c-a|: 3u + 5.8u.
inline constexpr double orientation_bound = 10 * unit_roundoff;

// det(a, b-a, c-a) of stored directions, relative to H = max(|b-a|, |c-a|) <= 2:
// 4 eta + 2 * (eta + 8.8u) = 45.2u, times 1.18.
inline constexpr double direction_orientation_bound = 54 * unit_roundoff;

// det(B, C, D) in double-double: exact data relative to |B||C||D|, and unit
// vectors known to 2^-100 relative to H^2.
inline constexpr double plane_double_double_bound = 0x1p-99;
inline constexpr double circle_double_double_bound = 0x1p-95;

// The step E from p to q on the sphere of q's length, from p, q and their lengths in doubles,
// relative to |q-p|: 21u, and terms of higher order.
inline constexpr double close_step_bound = 24 * unit_roundoff;

// What one product of a formula of Wides (wide.h) is off by, relative to its size. Rays from a center
// are off by u in each coordinate.
// det(a-o, b-o, c-o): 3u + 2u for products + 3u for sums.
inline constexpr double orientation_wide_bound = 10 * unit_roundoff;
// The determinant of side_of_circle_wide.cpp: 4u of each of its two first columns; of the last one
// 9.5u for h (4u for y^2 + z^2, 4.5u for |r| + x, u for their quotient), u for x, 2u; 2u for
// products, 3u for sums: 25.5u, and terms of higher order.
inline constexpr double circle_wide_bound = 32 * unit_roundoff;

// |b-p|^2 - |a-p|^2 of stored directions, relative to H = max(|a-p|, |b-p|) <= 2:
// 2 (4 eta + 10u) + 2u = 58.8u, and 2.9u for terms of higher order.
inline constexpr double angle_bound = 64 * unit_roundoff;

// One of the two against an exact number t, relative to max(|a-p|, sqrt(t)): 4 eta + 10u + 2u, and
// 2.7u for terms of higher order.
inline constexpr double within_angle_bound = 36 * unit_roundoff;

// The two values above in double-double, relative to H, of unit vectors known to 2^-100.
inline constexpr double angle_double_double_bound = 0x1p-95;

// (p-o).(a-b) of exact data, relative to the sum of the sizes of its three products: 5u.
inline constexpr double power_bound = 6 * unit_roundoff;

// (p-o).(a-o) - c |p-o| R of exact data, relative to |p-o| (|a-o| + |c| R): 7u.
inline constexpr double within_power_bound = 10 * unit_roundoff;

// Sums of products below this may have lost bits to underflow.
inline constexpr double min_product = 1e-270;

// The filters of exact data accept a determinant of three vectors only if the square of each length
// exceeds this. Overflow makes them unsure; docs/theory/filters.md shows that underflow is
// harmless then.
inline constexpr double min_squared_length = 1e-80;

}  // namespace rondel::predicates
