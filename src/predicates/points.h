// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where predicates take their points from. A predicate is asked about the names (indices) of
// points; a source has the points themselves, in each of the forms that a rung may need. A cheap
// form should be at hand, for the first rung; the others are looked at as rarely as that rung is
// unsure, so they may be computed then, and kept or not.
//
//     source                          keeps
//     models::ProjectedPoints         directions, and the low words of split unit vectors once asked
//     models::WeightedPoints          the points
//     bulk::GivenSites                references to sites and to directions
//     query::Target                   a reference to a model, and the query point
//     proof::PerturbedSites           directions
//     predicates::FourPoints          the points, for one question
#pragma once

#include <array>
#include <concepts>
#include <span>

#include "exact/unit_vector.h"
#include "exact/vector.h"
#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::predicates {

using Vector = exact::Vector3<double>;
using Quad = std::array<Point, 4>;  // b, c, d, p

template <class S>
concept PointSource = requires(S& points, Index a) {
  // Which predicates hold for the points.
  { S::model } -> std::convertible_to<Model>;
  // Point a as it was given, and the center of the sphere.
  { points.point(a) } -> std::convertible_to<Point>;
  { points.center() } -> std::convertible_to<Point>;
};

// In the projected model, where a point stands for its ray.
template <class S>
concept RaySource = PointSource<S> && requires(S& points, Index a) {
  // The unit vector of point a, off by at most `direction_error` (bounds.h).
  { points.direction(a) } -> std::convertible_to<Vector>;
  // The unit vector of point a, off by at most 2^-100, as an unevaluated sum.
  { points.split(a) } -> std::same_as<exact::SplitPoint>;
};

// The unit vector from the center to p != center, off by at most `direction_error`.
RONDEL_API Vector direction(const Point& p, const Point& center);
// Computes the same for many points.
RONDEL_API void directions(std::span<const Point> points, const Point& center, Vector* result);

// Points on the stack, named 0, 1, 2, 3. What a rung needs is computed when it asks.
template <Model m>
struct FourPoints {
  static constexpr Model model = m;

  std::array<Point, 4> points{};
  Point origin{};

  [[nodiscard]] const Point& point(Index i) const { return points[i]; }
  [[nodiscard]] const Point& center() const { return origin; }
  [[nodiscard]] Vector direction(Index i) const { return predicates::direction(points[i], origin); }
  [[nodiscard]] exact::SplitPoint split(Index i) const {
    return exact::unit_vector(points[i], origin);
  }
};

}  // namespace rondel::predicates
