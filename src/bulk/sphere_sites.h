// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites in several squares, of which merges meet few: a source of points for predicates, which
// remembers nothing but which rungs have decided.
#pragma once

#include <span>

#include "models/sphere_traits.h"
#include "predicates/conflict.h"
#include "predicates/orientation.h"

namespace rondel::bulk {

template <models::SphereModel T>
class SphereSites {
 public:
  static constexpr Model model = T::model;

  // The sites sites[order[0]], sites[order[1]], ... with their directions in the projected model.
  SphereSites(std::span<const Point> sites, std::span<const Index> order, const Point& center,
              const predicates::Vector* directions)
      : sites_(sites), order_(order), center_(center), directions_(directions) {}

  [[nodiscard]] Index size() const { return static_cast<Index>(order_.size()); }
  [[nodiscard]] const Point& point(Index i) const { return sites_[order_[i]]; }
  [[nodiscard]] const Point& center() const { return center_; }
  [[nodiscard]] const predicates::Vector& direction(Index i) const { return directions_[i]; }
  [[nodiscard]] exact::SplitPoint split(Index i) const {
    return exact::unit_vector(point(i), center_);
  }

  // As in SphereTraits.
  [[nodiscard]] predicates::Vector coordinates(Index i) const {
    if constexpr (model == Model::projected) return direction(i);
    return exact::to_vector(point(i));
  }
  [[nodiscard]] predicates::Vector from_center(Index i) const {
    if constexpr (model == Model::projected) return direction(i);
    return coordinates(i) - exact::to_vector(center_);
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

  // Of all conflict tests, given that this is called for those that a filter of the caller decided.
  void count_filtered() { ++tally_.filter; }
  [[nodiscard]] const Tally& tally() const { return tally_; }

 private:
  std::span<const Point> sites_;
  std::span<const Index> order_;
  Point center_;
  const predicates::Vector* directions_;
  Tally tally_;
};

}  // namespace rondel::bulk
