// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The conflict test: whether a site p lies above the face (b, c, d) of a hull. It alone decides what
// the result is, so it is exact, and ties are broken. This is its one ladder; builds, queries, the
// validator and the public predicates all climb it. A rung is sure of a sign or says zero, and then
// the next one is asked.
//
//     rung             projected (side_of_circle.h)             weighted (side_of_plane.h)
//     filter           4 directions in doubles                  4 points in doubles, from p
//     exact            -                                        integers of 128 bits, where they do
//     filter           -                                        in doubles, from the best of the 4
//     extended         4 split unit vectors with 64 bits        -
//     exact            integers of 128 bits, where they do      -
//     filter           4 points in doubles with exponents       -
//     double_double    4 split unit vectors in double-double    4 points in double-double
//     close            4 points in doubles, from the best       -
//     exact            a sum of 4 square roots                  balls of more and more words
//     perturbed        what is exactly zero (perturbation.h)    the same
//
// Divide and conquer has a filter of its own before the first rung, in coordinates of a square
// (bulk/square_sites.h): what this leaves open begins at conflict_above_filter().
#pragma once

#include <array>
#include <optional>

#include "predicates/perturbation.h"
#include "predicates/points.h"
#include "predicates/rung.h"
#include "predicates/scale.h"
#include "predicates/side_of_circle.h"
#include "predicates/side_of_plane.h"

namespace rondel::predicates {

template <PointSource S>
[[gnu::always_inline]] inline Sign conflict_filter(S& points, Index b, Index c, Index d, Index p) {
  if constexpr (S::model == Model::projected) {
    return side_of_circle_filter(points.direction(b), points.direction(c), points.direction(d),
                                 points.direction(p));
  } else {
    return side_of_plane_filter(to_vector(points.point(b)), to_vector(points.point(c)),
                                to_vector(points.point(d)), to_vector(points.point(p)));
  }
}

template <RaySource S>
Decision side_of_circle_above_filter(S& points, Index b, Index c, Index d, Index p) {
  const exact::SplitPoint u = points.split(b);
  const exact::SplitPoint v = points.split(c);
  const exact::SplitPoint w = points.split(d);
  const exact::SplitPoint x = points.split(p);
  Sign sign = Sign::zero;
  if (are_apart(u, x) || are_apart(v, x) || are_apart(w, x)) {
    sign = side_of_circle_extended(u, v, w, x);
    if (sign != Sign::zero) return {sign, Rung::extended};
  }
  const Quad given = {points.point(b), points.point(c), points.point(d), points.point(p)};
  // Close sites are hardly ever ties.
  if (are_apart(u, x)) {
    const auto exact = side_of_circle_integers_exact(given, points.center());
    if (exact) return {*exact, Rung::exact};
  }
  if (have_different_exponents(given, points.center())) {
    sign = side_of_circle_wide_filter(given, points.center());
    if (sign != Sign::zero) return {sign, Rung::filter};
  }
  sign = side_of_circle_double_double(u, v, w, x);
  if (sign != Sign::zero) return {sign, Rung::double_double};
  sign = side_of_circle_close(given, points.center());
  if (sign != Sign::zero) return {sign, Rung::close};
  return {side_of_circle_exact(given, points.center()), Rung::exact};
}

template <PointSource S>
Decision side_of_plane_above_filter(S& points, Index b, Index c, Index d, Index p) {
  const Quad given = {points.point(b), points.point(c), points.point(d), points.point(p)};
  if (const auto exact = side_of_plane_integers_exact(given)) return {*exact, Rung::exact};
  const Quad q = with_best_origin(given);
  const PlaneSteps steps = scaled_steps(q);
  Sign sign = side_of_plane_scaled_filter(steps);
  if (sign != Sign::zero) return {sign, Rung::filter};
  sign = side_of_plane_double_double(steps);
  if (sign != Sign::zero) return {sign, Rung::double_double};
  return {side_of_plane_exact(q), Rung::exact};
}

template <PointSource S>
Decision side_above_filter(S& points, Index b, Index c, Index d, Index p) {
  if constexpr (S::model == Model::projected) {
    return side_of_circle_above_filter(points, b, c, d, p);
  } else {
    return side_of_plane_above_filter(points, b, c, d, p);
  }
}

// The conflict test of what a filter has left open. Never zero.
template <PointSource S>
[[gnu::noinline]] Decision conflict_above_filter(S& points, Index b, Index c, Index d, Index p) {
  const Decision decision = side_above_filter(points, b, c, d, p);
  if (decision.sign != Sign::zero) return decision;
  const Point site = points.point(p);
  // In the place of a corner, p is in conflict with no face: not with those of the corner, and to
  // the others the corner is, perturbed, strictly below.
  if (site == points.point(b) || site == points.point(c) || site == points.point(d)) {
    return {Sign::negative, Rung::perturbed};
  }
  const bool is_in_conflict = is_in_conflict_perturbed(
      points.point(b), points.point(c), points.point(d), site, S::model, points.center());
  return {is_in_conflict ? Sign::positive : Sign::negative, Rung::perturbed};
}

// --- what others ask ---

// What the first rung of the projected model is sure of, for directions, or zero: for libraries
// above, which then ask the public predicate.
inline Sign sure_side_of_circle(const Vector& b, const Vector& c, const Vector& d,
                                const Vector& p) {
  return side_of_circle_filter(b, c, d, p);
}

// What the first rung of the conflict test is sure of, or zero. It remembers nothing of the sites, so
// that several threads may ask; what it leaves open, conflict() decides.
template <PointSource S>
[[gnu::always_inline]] inline Sign sure_conflict(const S& points, Index b, Index c, Index d,
                                                 Index p) {
  return conflict_filter(points, b, c, d, p);
}

// The side of p with respect to the face, without a perturbation: zero if the four are cocircular
// (projected) or coplanar (weighted).
template <PointSource S>
Decision side(S& points, Index b, Index c, Index d, Index p) {
  const Sign sign = conflict_filter(points, b, c, d, p);
  if (sign != Sign::zero) return {sign, Rung::filter};
  return side_above_filter(points, b, c, d, p);
}

// The conflict test: positive if p is in conflict with the face, never zero. Preconditions: as
// is_in_conflict in rondel/predicates.h, but p may be in the place of a corner.
template <PointSource S>
[[gnu::always_inline]] inline Decision conflict(S& points, Index b, Index c, Index d, Index p) {
  const Sign sign = conflict_filter(points, b, c, d, p);
  if (sign != Sign::zero) return {sign, Rung::filter};
  return conflict_above_filter(points, b, c, d, p);
}

// The conflict test of two faces at once: neither filter waits for the other.
template <PointSource S>
[[gnu::always_inline]] inline std::array<Decision, 2> conflicts(S& points,
                                                                const std::array<Index, 3>& f,
                                                                const std::array<Index, 3>& g,
                                                                Index p) {
  const Sign of_f = conflict_filter(points, f[0], f[1], f[2], p);
  const Sign of_g = conflict_filter(points, g[0], g[1], g[2], p);
  const auto decide = [&points, p](Sign sign, const std::array<Index, 3>& face) -> Decision {
    if (sign != Sign::zero) return {sign, Rung::filter};
    return conflict_above_filter(points, face[0], face[1], face[2], p);
  };
  return {decide(of_f, f), decide(of_g, g)};
}

}  // namespace rondel::predicates
