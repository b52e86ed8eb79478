// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The places of a constrained triangulation that changes, as dynamic::Editor stores them
// (models::SphereModel), and the two predicates that its faces ask. Filters in doubles are compiled
// here; whatever they are not sure of goes to the public predicates of the core.
//
// in    points by site, and the site that speaks for each place
// out   exact signs
// index places
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "models/sphere_traits.h"
#include "predicates/conflict.h"
#include "predicates/orientation.h"
#include "predicates/points.h"
#include "rondel/predicates.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "system/gather.h"
#include "system/prefetch.h"

namespace rondel::constrained {

class PlaceDirections {
 public:
  static constexpr Model model = Model::projected;
  static constexpr bool hides_sites = false;

  PlaceDirections() = default;
  PlaceDirections(std::span<const Point> input, std::span<const Index> order, const Point& center) {
    assign(input, order, center);
  }

  // These are the functions of SphereModel (models/sphere_traits.h).
  void assign(std::span<const Point> input, std::span<const Index> order, const Point& center) {
    rebind(input, order);
    sphere_.center = center;
    directions_.clear();
    for (Index a = 0; a < order.size(); ++a) set(a, input, order);
  }
  void rebind(std::span<const Point> input, std::span<const Index> order) {
    input_ = input;
    order_ = order;
  }
  void set(Index a, std::span<const Point> input, std::span<const Index> order) {
    rebind(input, order);
    if (a >= directions_.size()) directions_.resize(a + std::size_t{1});
    predicates::directions({&input[order[a]], 1}, sphere_.center, &directions_[a]);
  }
  void reorder(std::span<const Index> old, std::size_t room) {
    directions_ = system::gather(directions_, old, room);
  }
  void prefetch(Index a) const { system::prefetch(&directions_[a]); }

  // These are the functions of SphereTraits.
  [[nodiscard]] Index size() const { return static_cast<Index>(directions_.size()); }
  [[nodiscard]] const Point& center() const { return sphere_.center; }
  [[nodiscard]] const Point& point(Index a) const { return input_[order_[a]]; }
  [[nodiscard]] predicates::Vector coordinates(Index a) const { return directions_[a]; }
  [[nodiscard]] predicates::Vector from_center(Index a) const { return directions_[a]; }

  // Positive if place c is to the left of the great circle from a to b.
  [[nodiscard]] Sign orientation(Index a, Index b, Index c) const {
    const Sign sign = predicates::sure_orientation(directions_[a], directions_[b], directions_[c]);
    if (sign != Sign::zero) return sign;
    return rondel::orientation(point(a), point(b), point(c), sphere_);
  }
  // True if place p is in conflict with a face.
  [[nodiscard]] bool is_in_conflict(const Triple& face, Index p) const {
    const auto& [a, b, c] = face;
    const Sign sign = predicates::sure_side_of_circle(directions_[a], directions_[b],
                                                      directions_[c], directions_[p]);
    if (sign != Sign::zero) return sign == Sign::positive;
    return rondel::is_in_conflict(point(a), point(b), point(c), point(p), Model::projected,
                                  sphere_);
  }

 private:
  std::span<const Point> input_;
  std::span<const Index> order_;
  Sphere sphere_;  // whose radius does not matter
  std::vector<predicates::Vector> directions_;
};

static_assert(models::SphereModel<PlaceDirections>);

}  // namespace rondel::constrained
