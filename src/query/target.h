// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A query point together with the sites of a model: a source of points for predicates, and the
// traits of the kernel, with the query point under a name of its own. Remembers nothing and changes
// nothing in the sites, so that any number of threads may query at once.
#pragma once

#include <optional>

#include "models/sphere_traits.h"
#include "predicates/compare_distance.h"
#include "predicates/points.h"
#include "predicates/ray_order.h"
#include "predicates/within_angle.h"

namespace rondel::query {

using predicates::Vector;

// A vertex and how far it is, as far as doubles can tell.
struct Candidate {
  Index vertex = no_index;
  double value = 0;  // projected: squared distance of the directions; weighted: not used
};

// All at most an angle away, or all there are.
struct Limit {
  std::optional<predicates::Cosine> cosine;
  double squared_radius = 1;  // of the sphere
};

template <models::SphereTraits T>
class Target {
 public:
  static constexpr Model model = T::model;
  static constexpr bool hides_sites = T::hides_sites;
  static constexpr bool is_projected = model == Model::projected;
  // The name of the query point.
  static constexpr Index query = no_index - 1;

  Target(const T& sites, const Point& p) : sites_(sites), point_(p) {
    if constexpr (is_projected) {
      ray_ = predicates::direction(p, sites.center());
    } else {
      ray_ = exact::to_vector(p) - exact::to_vector(sites.center());
    }
  }

  // The traits.
  [[nodiscard]] Index size() const { return sites_.size(); }
  [[nodiscard]] Point point(Index a) const { return a == query ? point_ : sites_.point(a); }
  [[nodiscard]] Point center() const { return sites_.center(); }
  [[nodiscard]] Vector direction(Index a) const { return coordinates(a); }
  [[nodiscard]] exact::SplitPoint split(Index a) const {
    return exact::unit_vector(point(a), center());
  }
  [[nodiscard]] Vector coordinates(Index a) const {
    if (a != query) return sites_.coordinates(a);
    return is_projected ? ray_ : exact::to_vector(point_);
  }
  [[nodiscard]] Vector from_center(Index a) const {
    return a == query ? ray_ : sites_.from_center(a);
  }

  // Distances.
  [[nodiscard]] Candidate candidate(Index v) const {
    if constexpr (!is_projected) return {v, 0};
    const Vector d = sites_.coordinates(v) - ray_;
    return {v, dot(d, d)};
  }
  // Positive when a is nearer than b; exact.
  [[nodiscard]] Sign compare(const Candidate& a, const Candidate& b) const {
    if (a.vertex == b.vertex) return Sign::zero;
    if constexpr (is_projected) {
      return predicates::compare_angle(*this, a.vertex, a.value, b.vertex, b.value, query).sign;
    } else {
      return predicates::compare_power(*this, a.vertex, b.vertex, query).sign;
    }
  }
  [[nodiscard]] bool is_within(Index v, const Limit& limit) const {
    if (!limit.cosine) return true;
    if constexpr (is_projected) {
      return predicates::is_within_angle(*this, v, query, *limit.cosine).sign != Sign::negative;
    } else {
      return predicates::is_within_power(*this, v, query, *limit.cosine, limit.squared_radius)
                 .sign != Sign::negative;
    }
  }

  // Projected: whether v is on the ray of the query point. Weighted: whether it is in its place.
  [[nodiscard]] bool is_duplicate(const Candidate& v) const;

 private:
  const T& sites_;
  Point point_;
  Vector ray_;  // from the center: a direction (projected), a difference (weighted)
};

template <models::SphereTraits T>
bool Target<T>::is_duplicate(const Candidate& v) const {
  const Point a = sites_.point(v.vertex);
  if (!is_projected || a == point_) return a == point_;
  // Directions of one ray differ by at most twice `direction_error`.
  constexpr double far = 9 * predicates::direction_error * predicates::direction_error;
  if (v.value > far) return false;
  return predicates::are_on_one_ray(a, point_, sites_.center());
}

}  // namespace rondel::query
