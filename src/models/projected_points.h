// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The first approach of the paper (section 4.1): each point stands for its exact
// projection on the sphere.
#pragma once

#include <array>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "predicates/side_of_circle.h"
#include "predicates/tally.h"
#include "rondel/types.h"
#include "system/gather.h"
#include "system/prefetch.h"

namespace rondel::models {

// The direction of a point, within `direction_error` of the unit vector.
predicates::Vector direction(const Point& p, const Point& center);

class ProjectedPoints {
 public:
  static constexpr bool hides_sites = false;

  ProjectedPoints() = default;
  // `order` lists the input index of each spatial rank.
  ProjectedPoints(std::span<const Point> input, std::span<const Index> order, const Point& center) {
    assign(input, order, center);
  }
  // The same anew, in the memory that is there.
  void assign(std::span<const Point> input, std::span<const Index> order, const Point& center);

  // For sites that change: the arrays have moved or grown.
  void rebind(std::span<const Point> input, std::span<const Index> order) {
    input_ = input;
    order_ = order;
  }

  // For sites that change: site a has become input[order[a]]; a <= size().
  void set(Index a, std::span<const Point> input, std::span<const Index> order);

  // For sites that change: what was site old[a] becomes site a, and there are no others; rebind
  // follows.
  void reorder(std::span<const Index> old, std::size_t room) {
    directions_ = system::gather(directions_, old, room);
    low_parts_ = {};
    num_low_parts_ = 0;
  }

  [[nodiscard]] Index size() const { return static_cast<Index>(directions_.size()); }
  [[nodiscard]] const Point& center() const { return center_; }
  // Asks for the memory of the coordinates.
  void prefetch(Index a) const { system::prefetch(&directions_[a]); }
  // The site as given.
  [[nodiscard]] const Point& point(Index a) const { return input_[order_[a]]; }
  [[nodiscard]] predicates::Vector coordinates(Index a) const { return directions_[a]; }
  [[nodiscard]] predicates::Vector from_center(Index a) const { return directions_[a]; }

  [[nodiscard]] Sign orientation(Index a, Index b, Index c) const;

  [[nodiscard]] bool is_in_conflict(Index a, Index b, Index c, Index p) const {
    const Sign sign = predicates::side_of_circle_filter(directions_[a], directions_[b],
                                                        directions_[c], directions_[p]);
    return decide(sign, a, b, c, p);
  }

  // Two faces at once.
  [[nodiscard]] std::array<bool, 2> are_in_conflict(const std::array<Index, 3>& f,
                                                    const std::array<Index, 3>& g, Index p) const {
    const Sign first = predicates::side_of_circle_filter(directions_[f[0]], directions_[f[1]],
                                                         directions_[f[2]], directions_[p]);
    const Sign second = predicates::side_of_circle_filter(directions_[g[0]], directions_[g[1]],
                                                          directions_[g[2]], directions_[p]);
    return {decide(first, f[0], f[1], f[2], p), decide(second, g[0], g[1], g[2], p)};
  }

  // The same, where the filter is known to be unsure.
  [[nodiscard]] bool climb(Index a, Index b, Index c, Index p) const;

  // A conflict test that the caller's own filter has decided.
  void count_filtered() const { ++tally_.filter; }

  [[nodiscard]] const Tally& tally() const { return tally_; }

 private:
  // `sign` is what the filter says.
  [[nodiscard]] bool decide(Sign sign, Index a, Index b, Index c, Index p) const {
    if (sign == Sign::zero) return climb(a, b, c, p);
    ++tally_.filter;
    return sign == Sign::positive;
  }

  [[nodiscard]] exact::SplitPoint split_direction(Index a) const;
  void reserve_low_parts() const;
  void find_low_part(Index a) const;
  void find_low_parts() const;

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
  mutable LowParts low_parts_;
  mutable Index num_low_parts_ = 0;  // how often one was computed alone
  mutable Tally tally_;
};

}  // namespace rondel::models
