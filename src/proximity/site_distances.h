// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Exact comparisons of the distances between vertices, measured as angles at the center of the
// sphere.
//
// in    an unweighted triangulation
// out   chords of unit vectors (lengths and squares without unit), angles in radians, signs
// index sites; duplicates may be asked for as well
#pragma once

#include <vector>

#include "exact/eft.h"
#include "exact/unit_vector.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::proximity {

// Keeps the rays of the sites as unit vectors of twice a double's precision. Several threads may
// call its const functions at once.
class SiteDistances {
 public:
  // Precondition: Model::projected.
  SiteDistances(const Triangulation& triangulation, const Execution& execution);

  // Returns |u_a - u_b|^2 for the unit vectors u_a and u_b of two sites, with an error of at most
  // 2^-97 |u_a - u_b|.
  [[nodiscard]] exact::DoubleDouble squared(Index a, Index b) const;

  // Returns the angle between the rays of two sites in radians, with a relative error of at most
  // 8e-16 and an absolute one of at most 1e-29.
  [[nodiscard]] double angle(Index a, Index b) const;

  // Returns the sign of |ab| - |cd|, exactly: zero if and only if the two distances are equal.
  [[nodiscard]] Sign compare(Index a, Index b, Index c, Index d) const;
  // Returns the same sign as above, for a caller that has computed ab = squared(a, b) and cd =
  // squared(c, d) before.
  [[nodiscard]] Sign compare(Index a, Index b, exact::DoubleDouble ab, Index c, Index d,
                             exact::DoubleDouble cd) const;
  [[nodiscard]] bool is_shorter(Index a, Index b, Index c, Index d) const {
    return compare(a, b, c, d) == Sign::negative;
  }

  // True if c is in the closed cap with the diameter ab, that is if the angle acb of the unit
  // vectors is 90 degrees or more. If b is the antipode of a, every c is in the cap.
  [[nodiscard]] bool is_in_cap(Index a, Index b, Index c) const;

  [[nodiscard]] Point unit(Index a) const { return units_[a].hi; }

 private:
  Sites sites_;
  Point center_;
  std::vector<exact::SplitPoint> units_;
};

}  // namespace rondel::proximity
