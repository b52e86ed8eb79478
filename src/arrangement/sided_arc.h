// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// On which side of an arc points are, where doubles can tell.
#pragma once

#include <cmath>

#include "arrangement/noded_arcs.h"
#include "exact/vector.h"
#include "predicates/bounds.h"
#include "rondel/arrangement.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// A bound for dot(normal, p - a) of points p within the radius of the great circle of ab, and for
// the error of that, relative to the length of the step from a to b. The normal a x (b - a) is off
// by u (1 + 2 sqrt(2)) |b - a|, and the product by 3 u more, each times |p - a| <= 2: 13.7 u and terms
// of higher order. It is multiplied by the sum of the sizes of coordinates, which is not below the
// length.
inline constexpr double side_bound = 18 * predicates::unit_roundoff + 2 * arrangement_radius;

// An arc, and on which side of it points are.
class SidedArc {
 public:
  SidedArc(const Point& a, const Point& b) : a_(exact::to_vector(a)) {
    const Vec step = exact::to_vector(b) - a_;
    normal_ = cross(a_, step);
    // Steps whose products may underflow are never sure.
    constexpr double min_step = 0x1p-400;
    const double size = std::abs(step.x) + std::abs(step.y) + std::abs(step.z);
    limit_ = size > min_step ? side_bound * size : 1;
  }
  // Returns the side of a point, positive to the left; zero if the point may be within the radius
  // of the great circle.
  [[nodiscard]] int side(const Point& p) const {
    const double value = dot(normal_, exact::to_vector(p) - a_);
    return static_cast<int>(value > limit_) - static_cast<int>(value < -limit_);
  }

 private:
  Vec a_;
  Vec normal_{};
  double limit_ = 0;
};

}  // namespace rondel::arrangement
