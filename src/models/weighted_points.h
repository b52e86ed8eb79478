// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The second approach of the paper (section 4.2): each point is a weighted site, and the
// power test is the orientation of four points.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "predicates/side_of_plane.h"
#include "predicates/tally.h"
#include "rondel/types.h"
#include "system/gather.h"
#include "system/prefetch.h"

namespace rondel::models {

class WeightedPoints {
 public:
  static constexpr bool hides_sites = true;

  WeightedPoints() = default;
  // `order` lists the input index of each spatial rank.
  WeightedPoints(std::span<const Point> input, std::span<const Index> order, const Point& center) {
    assign(input, order, center);
  }
  // The same anew, in the memory that is there.
  void assign(std::span<const Point> input, std::span<const Index> order, const Point& center);

  // For sites that change: the arrays have moved or grown.
  void rebind(std::span<const Point> /*input*/, std::span<const Index> /*order*/) {}

  // For sites that change: site a has become input[order[a]]; a <= size().
  void set(Index a, std::span<const Point> input, std::span<const Index> order);

  // For sites that change: what was site old[a] becomes site a, and there are no others; rebind
  // follows.
  void reorder(std::span<const Index> old, std::size_t room) {
    points_ = system::gather(points_, old, room);
  }

  [[nodiscard]] Index size() const { return static_cast<Index>(points_.size()); }
  [[nodiscard]] Point center() const { return {center_.x, center_.y, center_.z}; }
  [[nodiscard]] Point point(Index a) const { return {points_[a].x, points_[a].y, points_[a].z}; }
  // Asks for the memory of the coordinates.
  void prefetch(Index a) const { system::prefetch(&points_[a]); }
  [[nodiscard]] predicates::Vector coordinates(Index a) const { return points_[a]; }
  [[nodiscard]] predicates::Vector from_center(Index a) const { return points_[a] - center_; }

  [[nodiscard]] Sign orientation(Index a, Index b, Index c) const;

  [[nodiscard]] bool is_in_conflict(Index a, Index b, Index c, Index p) const {
    const Sign sign =
        predicates::side_of_plane_filter(points_[a], points_[b], points_[c], points_[p]);
    return decide(sign, a, b, c, p);
  }

  // Two faces at once.
  [[nodiscard]] std::array<bool, 2> are_in_conflict(const std::array<Index, 3>& f,
                                                    const std::array<Index, 3>& g, Index p) const {
    const Sign first =
        predicates::side_of_plane_filter(points_[f[0]], points_[f[1]], points_[f[2]], points_[p]);
    const Sign second =
        predicates::side_of_plane_filter(points_[g[0]], points_[g[1]], points_[g[2]], points_[p]);
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

  std::vector<predicates::Vector> points_;
  predicates::Vector center_;
  mutable Tally tally_;
};

}  // namespace rondel::models
