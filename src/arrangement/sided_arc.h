// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// On which side of an arc points are, where doubles can tell.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

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

// Some points, coordinate by coordinate.
struct PointBatch {
  static constexpr std::size_t size = 16;
  std::array<double, size> x;
  std::array<double, size> y;
  std::array<double, size> z;
};

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
  // Returns a number whose bit i tells whether point i may be within the radius of the great circle.
  // The compiler makes vector code of this loop.
  [[nodiscard]] unsigned may_be_near(const PointBatch& points) const {
    std::array<double, PointBatch::size> bits;
    for (std::size_t i = 0; i < PointBatch::size; ++i) {
      const double value = normal_.x * (points.x[i] - a_.x) + normal_.y * (points.y[i] - a_.y) +
                           normal_.z * (points.z[i] - a_.z);
      const double place = places[i];
      bits[i] = std::abs(value) <= limit_ ? place : 0.0;
    }
    double sum = 0;
    for (const double bit : bits) sum += bit;
    return static_cast<unsigned>(static_cast<int>(sum));
  }

 private:
  static constexpr std::array<double, PointBatch::size> places = {
      0x1p0, 0x1p1, 0x1p2,  0x1p3,  0x1p4,  0x1p5,  0x1p6,  0x1p7,
      0x1p8, 0x1p9, 0x1p10, 0x1p11, 0x1p12, 0x1p13, 0x1p14, 0x1p15};

  Vec a_;
  Vec normal_{};
  double limit_ = 0;
};

}  // namespace rondel::arrangement
