// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Exact comparisons of the distances between vertices, all seen from the center.
#pragma once

#include <vector>

#include "exact/eft.h"
#include "exact/unit_vector.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::readings {

// The rays of the sites. Reads are safe from several threads.
class Chords {
 public:
  // Precondition: Model::projected.
  Chords(const Triangulation& triangulation, const Execution& execution);

  // |u_a - u_b|^2, off by at most 2^-97 |u_a - u_b|.
  [[nodiscard]] exact::DoubleDouble squared(Index a, Index b) const;

  // The angle between the rays, within 8e-16 of itself and 1e-29.
  [[nodiscard]] double angle(Index a, Index b) const;

  // The sign of |ab| - |cd|.
  [[nodiscard]] Sign compare(Index a, Index b, Index c, Index d) const;
  // The same with the squares at hand.
  [[nodiscard]] Sign compare(Index a, Index b, exact::DoubleDouble ab, Index c, Index d,
                             exact::DoubleDouble cd) const;
  [[nodiscard]] bool is_shorter(Index a, Index b, Index c, Index d) const {
    return compare(a, b, c, d) == Sign::negative;
  }

  // Whether c is in the closed cap with the diameter ab: the angle acb is 90 degrees or more.
  // If b is the antipode of a, every c is.
  [[nodiscard]] bool is_in_cap(Index a, Index b, Index c) const;

  [[nodiscard]] Point unit(Index a) const { return units_[a].hi; }

 private:
  Sites sites_;
  Point center_;
  std::vector<exact::SplitPoint> units_;
};

}  // namespace rondel::readings
