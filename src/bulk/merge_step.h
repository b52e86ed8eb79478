// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The tests of one step of a merge: they share the edge from l to r, and the faces on its left.
//
//        x         face(x): the face (l, r, x); its normal tells on which side of the edge x lies,
//       / \        so the orientation costs nothing beyond what the conflict test needs.
//      l-->r       A conflict test costs one dot product once the normal is known.
//
// All that the filters decide is inlined by force: one call left over, and the compiler keeps the
// vectors in memory.
#pragma once

#include <cmath>

#include "bulk/square_sites.h"

namespace rondel::bulk {

template <models::SphereModel T>
class MergeStep {
 public:
  using Sites = SquareSites<T>;
  using Limits = SquareLimits;
  static constexpr bool hides_sites = T::hides_sites;

  struct ApexFace {
    Index apex;
    SquareVector normal;
  };

  MergeStep(SquareSites<T>& sites, const SquareLimits& limits, Index l, Index r)
      : sites_(sites),
        points_(sites.points()),
        orientation_limit_(limits.orientation),
        conflict_limit_(limits.conflict),
        l_(l),
        r_(r) {
    const SquarePoint& origin = points_[l];
    origin_ = {origin.u, origin.v, origin.w};
    edge_ = from_l(r);
  }

  [[nodiscard]] Index l() const { return l_; }
  [[nodiscard]] Index r() const { return r_; }

  // The step of another edge.
  [[nodiscard]] MergeStep from_to(Index l, Index r) const {
    return {sites_, {orientation_limit_, conflict_limit_}, l, r};
  }

  [[nodiscard, gnu::always_inline]] ApexFace face(Index x) const {
    return {x, cross(edge_, from_l(x))};
  }

  // Positive if the apex lies to the left of the edge, seen from outside; zero if it is l or r.
  [[nodiscard, gnu::always_inline]] Sign orientation(const ApexFace& face) const {
    if (face.normal.w > orientation_limit_) return Sign::positive;
    if (face.normal.w < -orientation_limit_) return Sign::negative;
    // Overflow leaves infinities and what is not a number: unsure, too.
    return is_end(face.apex) ? Sign::zero : sites_.orientation(l_, r_, face.apex);
  }

  // Not if y is l or r.
  [[nodiscard, gnu::always_inline]] bool is_in_conflict(const ApexFace& face, Index y) const {
    const double value = dot(face.normal, from_l(y));
    if (value > conflict_limit_) {
      sites_.count_filtered();
      return false;
    }
    if (value < -conflict_limit_) {
      sites_.count_filtered();
      return true;
    }
    return !is_end(y) && sites_.is_in_conflict(l_, r_, face.apex, y, value);
  }

 private:
  // Of the ends no value is beyond the limits, which are never exceeded where zero is right.
  [[nodiscard]] bool is_end(Index x) const { return x == l_ || x == r_; }

  [[nodiscard, gnu::always_inline]] SquareVector from_l(Index x) const {
    const SquarePoint& p = points_[x];
    return {p.u - origin_.u, p.v - origin_.v, p.w - origin_.w};
  }

  SquareSites<T>& sites_;
  const SquarePoint* points_;
  double orientation_limit_;
  double conflict_limit_;
  Index l_;
  Index r_;
  SquareVector origin_;
  SquareVector edge_;
};

}  // namespace rondel::bulk
