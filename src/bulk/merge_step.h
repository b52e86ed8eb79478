// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The tests of one step of a merge: they share the edge from l to r, and the faces on its left.
//
//        x         face(x): the face (l, r, x); its normal tells on which side of the edge x lies,
//       / \        so the orientation costs nothing beyond what the conflict test needs.
//      l-->r       A conflict test costs one dot product once the normal is known.
//
// in    two sites, in coordinates that keep sides: of a square (SquareSites) or of space (GivenSites)
// out   exact signs: filters here, the rest is asked of the sites
// index local sites
//
// All that the filters decide is inlined by force: one call left over, and the compiler keeps the
// vectors in memory.
#pragma once

#include "rondel/types.h"

namespace rondel::bulk {

template <class Sites>
class MergeStep {
 public:
  using Vector = typename Sites::Vector;
  using Limits = typename Sites::Limits;

  struct ApexFace {
    Index apex;
    Vector normal;
    Vector side;  // the step from l to the apex
  };

  [[gnu::always_inline]] MergeStep(Sites& sites, Limits limits, Index l, Index r)
      : sites_(sites),
        limits_(limits),
        l_(l),
        r_(r),
        origin_(sites.coordinates(l)),
        edge_(sites.coordinates(r) - origin_) {}

  [[nodiscard]] Index l() const { return l_; }
  [[nodiscard]] Index r() const { return r_; }

  // The step of another edge.
  [[nodiscard]] MergeStep from_to(Index l, Index r) const { return {sites_, limits_, l, r}; }

  // The step from l to a site.
  [[nodiscard, gnu::always_inline]] Vector step_to(Index x) const {
    return sites_.coordinates(x) - origin_;
  }

  [[nodiscard, gnu::always_inline]] ApexFace face(Index x) const { return face(x, step_to(x)); }
  [[nodiscard, gnu::always_inline]] ApexFace face(Index x, const Vector& to_x) const {
    return {x, cross(edge_, to_x), to_x};
  }

  // Positive if the apex lies to the left of the edge, seen from outside; zero if it is l or r.
  [[nodiscard, gnu::always_inline]] Sign orientation(const ApexFace& face) const {
    const Sign sign = Sites::certain_orientation(limits_, origin_, face.normal, edge_, face.side);
    if (sign != Sign::zero) return sign;
    return is_end(face.apex) ? Sign::zero : sites_.orientation(l_, r_, face.apex);
  }

  // Whether y is in conflict with the face. An end of the edge, l or r, is not.
  [[nodiscard, gnu::always_inline]] bool is_in_conflict(const ApexFace& face, Index y) const {
    return is_in_conflict(face, y, step_to(y));
  }
  [[nodiscard, gnu::always_inline]] bool is_in_conflict(const ApexFace& face, Index y,
                                                        const Vector& to_y) const {
    const Sign sign = Sites::certain_side(limits_, dot(face.normal, to_y), edge_, face.side, to_y);
    if (sign != Sign::zero) {
      sites_.count_filtered();
      return sign == Sign::positive;
    }
    return !is_end(y) && sites_.is_in_conflict(l_, r_, face.apex, y);
  }

 private:
  // True for the ends of the edge, for which no filter is certain, as zero is right.
  [[nodiscard]] bool is_end(Index x) const { return x == l_ || x == r_; }

  Sites& sites_;
  Limits limits_;
  Index l_;
  Index r_;
  Vector origin_;
  Vector edge_;
};

}  // namespace rondel::bulk
