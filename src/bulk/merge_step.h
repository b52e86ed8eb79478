// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The tests of one step of a merge: they share the edge from l to r, and the faces on its left.
//
//        x         face(x): the face (l, r, x); its normal tells on which side of the edge x lies,
//       / \        so the orientation costs nothing beyond what the conflict test needs.
//      l-->r       A conflict test costs one dot product once the normal is known.
#pragma once

#include <cmath>

#include "bulk/cell_sites.h"

namespace rondel::bulk {

template <incremental::SphereTraits T>
class MergeStep {
 public:
  using Sites = CellSites<T>;
  using Limits = CellLimits;
  static constexpr bool hides_sites = T::hides_sites;

  struct Face {
    Index apex;
    CellVector normal;
  };

  MergeStep(const CellSites<T>& sites, const CellLimits& limits, Index l, Index r)
      : sites_(sites), points_(sites.points()), limits_(limits), l_(l), r_(r) {
    const CellPoint& origin = points_[l];
    origin_ = {origin.u, origin.v, origin.w};
    edge_ = from_l(r);
  }

  [[nodiscard]] Index l() const { return l_; }
  [[nodiscard]] Index r() const { return r_; }

  // The step of another edge.
  [[nodiscard]] MergeStep from_to(Index l, Index r) const { return {sites_, limits_, l, r}; }

  [[nodiscard]] Face face(Index x) const { return {x, cross(edge_, from_l(x))}; }

  // Positive if the apex lies to the left of the edge, seen from outside.
  [[nodiscard]] Sign orientation(const Face& face) const {
    // Overflow leaves infinities and what is not a number: unsure, too.
    if (!(std::abs(face.normal.w) > limits_.orientation)) [[unlikely]] {
      return sites_.orientation(l_, r_, face.apex);
    }
    return face.normal.w > 0 ? Sign::positive : Sign::negative;
  }

  [[nodiscard]] bool is_in_conflict(const Face& face, Index y) const {
    const double value = dot(face.normal, from_l(y));
    if (!(std::abs(value) > limits_.conflict)) [[unlikely]] {
      return sites_.is_in_conflict(l_, r_, face.apex, y, value);
    }
    sites_.count_filtered();
    return value < 0;
  }

 private:
  [[nodiscard]] CellVector from_l(Index x) const {
    const CellPoint& p = points_[x];
    return {p.u - origin_.u, p.v - origin_.v, p.w - origin_.w};
  }

  const CellSites<T>& sites_;
  const CellPoint* points_;
  CellLimits limits_;
  Index l_;
  Index r_;
  CellVector origin_;
  CellVector edge_;
};

}  // namespace rondel::bulk
