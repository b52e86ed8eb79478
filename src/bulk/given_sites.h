// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites as they are given: what the ladders of predicates/ read, and the coordinates of merges
// between squares, which meet few of the sites.
//
// in    the sites of a piece and, in the projected model, perhaps their directions
// out   exact signs, and how often each rung decided a conflict test
// index local sites
#pragma once

#include "bulk/input.h"
#include "models/sphere_traits.h"
#include "predicates/bounds.h"
#include "predicates/orientation.h"

namespace rondel::bulk {

// A source of points (predicates/points.h) that remembers nothing of them.
template <models::SphereModel T>
class GivenSites {
 public:
  static constexpr Model model = T::model;
  static constexpr bool hides_sites = T::hides_sites;

  using Vector = predicates::Vector;
  struct Limits {};  // of filters: these need none

  GivenSites() = default;
  // Directions are needed in the projected model, but for rungs above the filter.
  explicit GivenSites(const Input& input, const Vector* directions = nullptr)
      : sites_(input.sites),
        order_(input.order),
        center_(input.center()),
        directions_(directions) {}

  [[nodiscard]] Index size() const { return static_cast<Index>(order_.size()); }
  [[nodiscard]] const Point& point(Index i) const { return sites_[order_[i]]; }
  [[nodiscard]] const Point& center() const { return center_; }
  [[nodiscard]] const Vector& direction(Index i) const { return directions_[i]; }
  [[nodiscard]] exact::SplitPoint split(Index i) const {
    return exact::unit_vector(point(i), center_);
  }

  // Returns the coordinates with the meaning that they have in SphereTraits.
  [[nodiscard]] Vector coordinates(Index i) const {
    if constexpr (model == Model::projected) return direction(i);
    return exact::to_vector(point(i));
  }
  [[nodiscard]] Vector from_center(Index i) const {
    if constexpr (model == Model::projected) return direction(i);
    return coordinates(i) - exact::to_vector(center_);
  }

  // The filters of one step of a merge, see merge_step.h; zero if they are not certain. `normal` is
  // that of the face (l, r, x), `value` its product with the step from l to y, and `to_r`, `to_x` and
  // `to_y` are the steps from l. Most values are beyond what the bounds come to at the largest
  // distances, so that these are not computed.
  [[nodiscard, gnu::always_inline]] static Sign certain_orientation(Limits /*limits*/,
                                                                    const Vector& l,
                                                                    const Vector& normal,
                                                                    const Vector& to_r,
                                                                    const Vector& to_x) {
    if constexpr (model == Model::weighted) return Sign::zero;
    constexpr double bound = predicates::direction_orientation_bound;
    const double value = dot(l, normal);
    if (value > bound * max_distance) return Sign::positive;
    if (value < -bound * max_distance) return Sign::negative;
    return predicates::unless_unsure(
        value, value * value > bound * bound * std::max(dot(to_r, to_r), dot(to_x, to_x)));
  }
  [[nodiscard, gnu::always_inline]] static Sign certain_side(Limits /*limits*/, double value,
                                                             const Vector& to_r, const Vector& to_x,
                                                             const Vector& to_y) {
    if constexpr (model == Model::projected) {
      constexpr double most = predicates::circle_plane_bound * (max_distance * max_distance);
      if (value > most) return Sign::positive;
      if (value < -most) return Sign::negative;
    }
    const double r2 = dot(to_r, to_r);
    const double x2 = dot(to_x, to_x);
    const double y2 = dot(to_y, to_y);
    const bool is_sure =
        model == Model::weighted
            ? predicates::is_beyond(value, predicates::plane_bound, r2, x2, y2)
            : predicates::is_beyond_longest(value, predicates::circle_plane_bound, r2, x2, y2);
    return predicates::unless_unsure(value, is_sure);
  }

  // Exact.
  [[nodiscard]] Sign orientation(Index a, Index b, Index c) const {
    return predicates::orientation(*this, a, b, c).sign;
  }
  [[nodiscard]] bool is_in_conflict(Index a, Index b, Index c, Index p) {
    const predicates::Decision decision = predicates::conflict(*this, a, b, c, p);
    count(tally_, decision.rung);
    return decision.sign == Sign::positive;
  }

  // The tally counts all conflict tests, provided that count_filtered() is called for those that a
  // filter of the caller decided.
  void count_filtered() { ++tally_.filter; }
  [[nodiscard]] const Tally& tally() const { return tally_; }

 private:
  // The bound for the distance of two stored directions.
  static constexpr double max_distance = 2.001;

  std::span<const Point> sites_;
  std::span<const Index> order_;
  Point center_;
  const Vector* directions_ = nullptr;
  Tally tally_{};
};

}  // namespace rondel::bulk
