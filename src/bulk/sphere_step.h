// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The questions of one step of a merge, as in merge_step.h, for parts that are in several squares:
// the bounds of the filters, which hold for all sites, applied to what the questions of a step
// have in common. What they leave open goes up the ladder of predicates/conflict.h.
#pragma once

#include <algorithm>
#include <cmath>

#include "bulk/sphere_sites.h"
#include "predicates/bounds.h"
#include "predicates/rung.h"

namespace rondel::bulk {

template <models::SphereModel T>
class SphereStep {
 public:
  using Sites = SphereSites<T>;
  struct Limits {};
  struct ApexFace {
    Index apex;
    predicates::Vector normal;  // outward
    double squared;             // of the side from l to the apex
  };
  static constexpr bool hides_sites = T::hides_sites;

  SphereStep(Sites& sites, const Limits& /*limits*/, Index l, Index r)
      : sites_(sites),
        l_(l),
        r_(r),
        origin_(sites.coordinates(l)),
        edge_(sites.coordinates(r) - origin_),
        squared_(dot(edge_, edge_)) {}

  [[nodiscard]] Index l() const { return l_; }
  [[nodiscard]] Index r() const { return r_; }
  [[nodiscard]] SphereStep from_to(Index l, Index r) const { return {sites_, {}, l, r}; }

  [[nodiscard]] ApexFace face(Index x) const {
    const predicates::Vector side = sites_.coordinates(x) - origin_;
    return {x, cross(edge_, side), dot(side, side)};
  }

  // Positive if the apex lies to the left of the edge from l to r, seen from outside.
  [[nodiscard]] Sign orientation(const ApexFace& face) const {
    if constexpr (T::model == Model::projected) {
      constexpr double bound = predicates::direction_orientation_bound;
      const double value = dot(origin_, face.normal);
      if (value * value > bound * bound * std::max(squared_, face.squared)) {
        return exact::sign_of(value);
      }
    }
    return is_end(face.apex) ? Sign::zero : sites_.orientation(l_, r_, face.apex);
  }

  [[nodiscard]] bool is_in_conflict(const ApexFace& face, Index y) const {
    const predicates::Vector to_y = sites_.coordinates(y) - origin_;
    const double value = dot(face.normal, to_y);
    const double squared = dot(to_y, to_y);
    const bool is_sure =
        T::model == Model::weighted
            ? predicates::is_beyond(value, predicates::plane_bound, squared_, face.squared, squared)
            : predicates::is_beyond_longest(value, predicates::circle_plane_bound, squared_,
                                            face.squared, squared);
    if (is_sure) {
      sites_.count_filtered();
      return value > 0;
    }
    return !is_end(y) && sites_.is_in_conflict(l_, r_, face.apex, y);
  }

 private:
  [[nodiscard]] bool is_end(Index x) const { return x == l_ || x == r_; }

  Sites& sites_;
  Index l_;
  Index r_;
  predicates::Vector origin_;
  predicates::Vector edge_;
  double squared_;
};

}  // namespace rondel::bulk
