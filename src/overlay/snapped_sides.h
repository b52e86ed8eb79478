// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Snaps corners to sides. A corner that is on a side only up to rounding may be on either side of
// it, so that sides that should touch cross. Such corners become corners of the side.
//
// in    points, and sides with the cell to their left
// out   the sides, divided at the corners near them
// index points; owners are cells
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "predicates/bounds.h"
#include "rondel/types.h"
#include "system/disjoint_sets.h"

namespace rondel::overlay {

// A directed side between two points, with the cell `owner` to its left.
struct OwnedSide {
  Index from;
  Index to;
  Index owner;
  friend auto operator<=>(const OwnedSide&, const OwnedSide&) = default;
};

// The distance within which corners are snapped. Corners where sides cross are off by some 10u;
// has_sure_crossing() uses the same distance.
inline constexpr double snapping_distance = 32 * predicates::unit_roundoff;

// The corners near sides, and points that are merged because they are near each other.
class Snaps {
 public:
  // Finds the corners of these sides that are within `distance` of other sides.
  Snaps(std::span<const Point> points, std::span<const OwnedSide> sides,
        double distance = snapping_distance);
  [[nodiscard]] bool is_empty() const { return passed_.empty() && !merged_; }
  // True if snapping changes any of these sides, which need not be those of the constructor.
  [[nodiscard]] bool would_change(std::span<const OwnedSide> sides) const;
  // Returns the sides divided at all corners near them, without those that then cancel for their
  // owner, and sorted.
  [[nodiscard]] std::vector<OwnedSide> applied(std::span<const OwnedSide> sides) const;

 private:
  // A corner on the path from the lower end of a side to the higher one.
  struct PassedCorner {
    Index low;
    Index high;
    double part;  // how far along the side the corner is, in any unit
    Index corner;
  };

  [[nodiscard]] bool is_nearly(const Point& a, const Point& b) const;
  [[nodiscard]] Index name(Index p) const { return merged_ ? (*merged_)[p] : p; }
  void join(Index p, Index q);
  void take(Index low, Index high, Index corner);
  [[nodiscard]] std::span<const PassedCorner> passed_by(const OwnedSide& side) const;

  std::span<const Point> points_;
  double distance_;
  std::optional<system::DisjointSets> merged_;  // the points, once two of them are merged
  std::vector<PassedCorner> passed_;
};

}  // namespace rondel::overlay
