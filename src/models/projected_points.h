// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The first approach of the paper (section 4.1): each point stands for its exact
// projection on the sphere.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "predicates/points.h"
#include "rondel/types.h"
#include "system/gather.h"
#include "system/prefetch.h"

namespace rondel::models {

class ProjectedPoints {
 public:
  static constexpr Model model = Model::projected;
  static constexpr bool hides_sites = false;

  ProjectedPoints() = default;
  // `order` lists the input index of each spatial rank.
  ProjectedPoints(std::span<const Point> input, std::span<const Index> order, const Point& center) {
    assign(input, order, center);
  }

  // These are the functions of SphereModel (sphere_traits.h).
  void assign(std::span<const Point> input, std::span<const Index> order, const Point& center);
  void rebind(std::span<const Point> input, std::span<const Index> order) {
    input_ = input;
    order_ = order;
  }
  void set(Index a, std::span<const Point> input, std::span<const Index> order);
  double move_all(std::span<const Point> input, std::span<const Index> order,
                  std::span<const Index> in_use, unsigned threads);
  void reorder(std::span<const Index> old, std::size_t room) {
    directions_ = system::gather(directions_, old, room);
    low_parts_ = {};
    num_low_parts_ = 0;
  }
  void prefetch(Index a) const { system::prefetch(&directions_[a]); }

  // These are the functions of SphereTraits.
  [[nodiscard]] Index size() const { return static_cast<Index>(directions_.size()); }
  [[nodiscard]] const Point& center() const { return center_; }
  [[nodiscard]] const Point& point(Index a) const { return input_[order_[a]]; }
  [[nodiscard]] const predicates::Vector& direction(Index a) const { return directions_[a]; }
  [[nodiscard]] predicates::Vector coordinates(Index a) const { return directions_[a]; }
  [[nodiscard]] predicates::Vector from_center(Index a) const { return directions_[a]; }

  // The split unit vector, whose high part is the direction. Remembers the low part.
  [[nodiscard]] exact::SplitPoint split(Index a) {
    if (a >= low_parts_.size || !is_known(low_parts_.data[a])) find_low_part(a);
    return {exact::to_point(directions_[a]), low_parts_.data[a]};
  }

 private:
  // Low parts that are not known yet are zero. The negative zero is not.
  static bool is_known(const Point& low) {
    const auto bits = std::bit_cast<std::array<std::uint64_t, 3>>(low);
    return (bits[0] | bits[1] | bits[2]) != 0;
  }
  static Point low_part(const predicates::Vector& high, const exact::SplitPoint& u);
  void reserve_low_parts();
  void find_low_part(Index a);
  void find_low_parts();

  struct Free {
    void operator()(Point* p) const { std::free(p); }
  };
  struct LowParts {
    std::unique_ptr<Point[], Free> data;
    std::size_t size = 0;
  };

  std::span<const Point> input_;
  std::span<const Index> order_;
  Point center_;
  std::vector<predicates::Vector> directions_;
  // What the directions lack of the exact unit vectors, computed when first needed. Zero
  // pages from calloc take no memory before that.
  LowParts low_parts_;
  Index num_low_parts_ = 0;  // how often one was computed alone
};

}  // namespace rondel::models
