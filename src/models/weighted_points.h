// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The second approach of the paper (section 4.2): each point is a weighted site, and the
// power test is the orientation of four points.
#pragma once

#include <span>
#include <vector>

#include "exact/vector.h"
#include "predicates/points.h"
#include "rondel/types.h"
#include "system/gather.h"
#include "system/prefetch.h"

namespace rondel::models {

class WeightedPoints {
 public:
  static constexpr Model model = Model::weighted;
  static constexpr bool hides_sites = true;

  WeightedPoints() = default;
  // `order` lists the input index of each spatial rank.
  WeightedPoints(std::span<const Point> input, std::span<const Index> order, const Point& center) {
    assign(input, order, center);
  }

  // These are the functions of SphereModel (sphere_traits.h).
  void assign(std::span<const Point> input, std::span<const Index> order, const Point& center);
  void rebind(std::span<const Point> /*input*/, std::span<const Index> /*order*/) {}
  void set(Index a, std::span<const Point> input, std::span<const Index> order);
  double move_all(std::span<const Point> input, std::span<const Index> order,
                  std::span<const Index> in_use, unsigned threads);
  void reorder(std::span<const Index> old, std::size_t room) {
    points_ = system::gather(points_, old, room);
  }
  void prefetch(Index a) const { system::prefetch(&points_[a]); }

  // These are the functions of SphereTraits.
  [[nodiscard]] Index size() const { return static_cast<Index>(points_.size()); }
  [[nodiscard]] Point center() const { return exact::to_point(center_); }
  [[nodiscard]] Point point(Index a) const { return exact::to_point(points_[a]); }
  [[nodiscard]] predicates::Vector coordinates(Index a) const { return points_[a]; }
  [[nodiscard]] predicates::Vector from_center(Index a) const { return points_[a] - center_; }

 private:
  std::vector<predicates::Vector> points_;
  predicates::Vector center_;
};

}  // namespace rondel::models
