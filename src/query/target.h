// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A query point together with the sites: the predicates of queries, and the traits of the kernel
// with the query point under a name of its own. Changes nothing in the sites, so
// that any number of threads may query at once.
#pragma once

#include <array>

#include "models/projected_points.h"
#include "models/sphere_traits.h"
#include "predicates/compare_distance.h"
#include "predicates/orientation.h"
#include "predicates/perturbation.h"
#include "predicates/ray_order.h"
#include "predicates/side_of_circle.h"
#include "predicates/side_of_plane.h"
#include "predicates/within_angle.h"

namespace rondel::query {

using predicates::Vector;

// A vertex and how far it is, as far as doubles can tell.
struct Candidate {
  Index vertex = no_index;
  double value = 0;  // projected: squared distance of the directions; weighted: not used
};

template <models::SphereTraits T>
class Target {
 public:
  static constexpr bool hides_sites = T::hides_sites;
  static constexpr Model model = hides_sites ? Model::weighted : Model::projected;
  // The name of the query point.
  static constexpr Index query = no_index - 1;

  Target(const T& sites, const Point& p) : sites_(sites), point_(p) {
    if constexpr (hides_sites) {
      ray_ = exact::to_vector(p) - exact::to_vector(sites.center());
    } else {
      ray_ = models::direction(p, sites.center());
    }
  }

  // The traits.
  [[nodiscard]] Index size() const { return sites_.size(); }
  [[nodiscard]] Vector coordinates(Index a) const {
    if (a != query) return sites_.coordinates(a);
    return hides_sites ? exact::to_vector(point_) : ray_;
  }
  [[nodiscard]] Vector from_center(Index a) const {
    return a == query ? ray_ : sites_.from_center(a);
  }
  [[nodiscard]] Sign orientation(Index a, Index b, Index c) const;
  [[nodiscard]] bool is_in_conflict(Index a, Index b, Index c, Index p) const;
  [[nodiscard]] std::array<bool, 2> are_in_conflict(const std::array<Index, 3>& f,
                                                    const std::array<Index, 3>& g, Index p) const {
    return {is_in_conflict(f[0], f[1], f[2], p), is_in_conflict(g[0], g[1], g[2], p)};
  }

  // Distances.
  [[nodiscard]] Candidate candidate(Index v) const {
    if constexpr (hides_sites) return {v, 0};
    const Vector d = sites_.coordinates(v) - ray_;
    return {v, dot(d, d)};
  }
  // Positive when a is nearer than b; exact.
  [[nodiscard]] Sign compare(const Candidate& a, const Candidate& b) const {
    Sign sign = Sign::zero;
    if constexpr (hides_sites) {
      sign = predicates::compare_power_filter(sites_.coordinates(a.vertex),
                                              sites_.coordinates(b.vertex), ray_);
    } else {
      sign = predicates::compare_angle_filter(a.value, b.value);
    }
    return sign != Sign::zero || a.vertex == b.vertex ? sign : climb(a, b);
  }
  [[nodiscard]] bool is_within(Index v, const predicates::Cosine& cosine,
                               const Sphere& sphere) const;

  // Projected: whether v is on the ray of the query point. Weighted: whether it is in its place.
  [[nodiscard]] bool is_duplicate(const Candidate& v) const;

 private:
  [[nodiscard]] Point point(Index a) const { return a == query ? point_ : sites_.point(a); }
  [[nodiscard]] Sign climb(const Candidate& a, const Candidate& b) const;

  const T& sites_;
  Point point_;
  Vector ray_;  // from the center: a direction (projected), a difference (weighted)
};

template <models::SphereTraits T>
Sign Target<T>::climb(const Candidate& a, const Candidate& b) const {
  const Point pa = sites_.point(a.vertex);
  const Point pb = sites_.point(b.vertex);
  const auto decision = hides_sites
                            ? predicates::compare_power_ladder(pa, pb, point_, sites_.center())
                            : predicates::compare_angle_ladder(pa, pb, point_, sites_.center());
  return decision.sign;
}

template <models::SphereTraits T>
Sign Target<T>::orientation(Index a, Index b, Index c) const {
  if constexpr (!hides_sites) {
    const Sign sign =
        predicates::orientation_filter(coordinates(a), coordinates(b), coordinates(c));
    if (sign != Sign::zero) return sign;
  }
  return predicates::orientation_ladder(point(a), point(b), point(c), sites_.center()).sign;
}

template <models::SphereTraits T>
bool Target<T>::is_in_conflict(Index a, Index b, Index c, Index p) const {
  Sign sign = Sign::zero;
  if constexpr (hides_sites) {
    sign = predicates::side_of_plane_filter(coordinates(a), coordinates(b), coordinates(c),
                                            coordinates(p));
    if (sign == Sign::zero) {
      sign = predicates::side_of_plane_ladder(point(a), point(b), point(c), point(p)).sign;
    }
  } else {
    sign = predicates::side_of_circle_filter(coordinates(a), coordinates(b), coordinates(c),
                                             coordinates(p));
    if (sign == Sign::zero) {
      sign =
          predicates::side_of_circle_ladder(point(a), point(b), point(c), point(p), sites_.center())
              .sign;
    }
  }
  if (sign != Sign::zero) return sign == Sign::positive;
  // A query point in the place of a vertex is in conflict with no face: not with those of the
  // vertex, and to the others the vertex is, perturbed, strictly below.
  const Point q = point(p);
  if (q == point(a) || q == point(b) || q == point(c)) return false;
  return predicates::is_in_conflict_perturbed(point(a), point(b), point(c), q, model,
                                              sites_.center());
}

template <models::SphereTraits T>
bool Target<T>::is_within(Index v, const predicates::Cosine& cosine, const Sphere& sphere) const {
  if constexpr (hides_sites) {
    return predicates::is_within_power_ladder(sites_.point(v), point_, cosine, sphere).sign !=
           Sign::negative;
  } else {
    const Sign sign = predicates::is_within_angle_filter(sites_.coordinates(v), ray_, cosine);
    if (sign != Sign::zero) return sign == Sign::positive;
    return predicates::is_within_angle_ladder(sites_.point(v), point_, cosine, sphere.center)
               .sign != Sign::negative;
  }
}

template <models::SphereTraits T>
bool Target<T>::is_duplicate(const Candidate& v) const {
  const Point a = sites_.point(v.vertex);
  if (hides_sites || a == point_) return a == point_;
  // Directions of one ray differ by at most twice `direction_error`.
  constexpr double far = 9 * predicates::direction_error * predicates::direction_error;
  if (v.value > far) return false;
  return predicates::are_on_one_ray(a, point_, sites_.center());
}

}  // namespace rondel::query
