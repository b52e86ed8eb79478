// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Corners that are on a side only to rounding may be on either side of it, so that sides cross which should touch. Such
// corners become corners of that side.
#pragma once

#include <span>
#include <vector>

#include "predicates/bounds.h"
#include "rondel/types.h"

namespace rondel::overlay {

// A side from one point to another, by index, with its owner to the left.
struct OwnedSide {
  Index from;
  Index to;
  Index owner;
  friend auto operator<=>(const OwnedSide&, const OwnedSide&) = default;
};

// Corners where sides cross are off by some 10u; has_sure_crossing() allows as much.
inline constexpr double snapping_distance = 32 * predicates::unit_roundoff;

class Snaps {
 public:
  // Finds the corners of these sides that are as near as this to others of them.
  Snaps(std::span<const Point> points, std::span<const OwnedSide> sides,
        double distance = snapping_distance);
  [[nodiscard]] bool is_empty() const { return passed_.empty() && !has_joined_; }
  // Whether these sides, which may be others, become others.
  [[nodiscard]] bool change(std::span<const OwnedSide> sides) const;
  // These sides by all corners that are on them, and without what then runs to and fro around one owner. They are sorted.
  [[nodiscard]] std::vector<OwnedSide> applied(std::span<const OwnedSide> sides) const;

 private:
  // A corner on the way from one end, the lower one, of a side to the other one.
  struct PassedCorner {
    Index low;
    Index high;
    double part;  // of the way, times a number
    Index corner;
  };

  [[nodiscard]] bool is_nearly(const Point& a, const Point& b) const;
  [[nodiscard]] Index name(Index p) const;
  void join(Index p, Index q);
  void take(Index low, Index high, Index corner);
  [[nodiscard]] std::span<const PassedCorner> passed_by(const OwnedSide& side) const;

  std::span<const Point> points_;
  double distance_;
  std::vector<Index> parents_;  // of points that become one, the lowest stands for all
  std::vector<PassedCorner> passed_;
  bool has_joined_ = false;
};

}  // namespace rondel::overlay
