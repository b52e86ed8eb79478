// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites in several squares, of which merges meet few.
#pragma once

#include <array>
#include <span>
#include <type_traits>

#include "models/projected_points.h"
#include "models/sphere_traits.h"
#include "models/weighted_points.h"
#include "predicates/tally.h"

namespace rondel::bulk {

template <models::SphereTraits T>
class SphereSites {
 public:
  static constexpr bool has_weights = std::is_same_v<T, models::WeightedPoints>;

  // The sites sites[order[0]], sites[order[1]], ... with their directions, if these are of use.
  SphereSites(std::span<const Point> sites, std::span<const Index> order, const Point& center,
              const predicates::Vector* directions)
      : sites_(sites), order_(order), center_(center), directions_(directions) {}

  [[nodiscard]] Index size() const { return static_cast<Index>(order_.size()); }
  [[nodiscard]] const Point& site(Index i) const { return sites_[order_[i]]; }
  [[nodiscard]] const Point& center() const { return center_; }

  // As in SphereTraits.
  [[nodiscard]] predicates::Vector coordinates(Index i) const {
    if constexpr (has_weights) {
      return exact::to_vector(site(i));
    } else {
      return directions_[i];
    }
  }
  [[nodiscard]] predicates::Vector from_center(Index i) const {
    if constexpr (has_weights) {
      return coordinates(i) - exact::to_vector(center_);
    } else {
      return directions_[i];
    }
  }
  [[nodiscard]] Sign orientation(Index a, Index b, Index c) const {
    return ask(std::array{a, b, c}).orientation(0, 1, 2);
  }
  [[nodiscard]] bool is_in_conflict(Index a, Index b, Index c, Index p) const {
    const T& traits = ask(std::array{a, b, c, p});
    const bool answer = traits.is_in_conflict(0, 1, 2, 3);
    predicates::add(tally_, traits.tally());
    return answer;
  }

  // A conflict test that the caller's own filter has decided.
  void count_filtered() const { ++tally_.filter; }
  [[nodiscard]] const Tally& tally() const { return tally_; }

 private:
  template <std::size_t N>
  const T& ask(const std::array<Index, N>& indices) const {
    for (std::size_t i = 0; i < N; ++i) few_order_[i] = order_[indices[i]];
    few_.assign(sites_, std::span(few_order_).first(N), center_);
    return few_;
  }

  std::span<const Point> sites_;
  std::span<const Index> order_;
  Point center_;
  const predicates::Vector* directions_;
  mutable std::array<Index, 4> few_order_{};
  mutable T few_;
  mutable Tally tally_;
};

}  // namespace rondel::bulk
