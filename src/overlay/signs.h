// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Exact orientations of the points of two partitions, of which the second one, the cover, is turned by
// an infinitesimal rotation: no point of one lies on an edge of the other, and every two edges cross
// in their inside or not at all. So equal grids, shared corners and shared edges are no special cases.
//
// The rotation w = (d, d^1.3, d^1.6), for d that tends to 0, takes y to y + w x y. Where a
// determinant vanishes its change of first order decides, which is w.v with a vector v that is not
// zero: a (y.b) - b (y.a) for det(a, b, y), and z (x.y) - y (x.z) for det(x, y, z), where y, z are
// points of the cover. The sign is that of v's first coordinate that is not zero, because all that
// is of second order is at most of order d^2.
#pragma once

#include <cmath>

#include "exact/vector.h"
#include "predicates/bounds.h"
#include "rondel/predicates.h"
#include "rondel/types.h"

namespace rondel::overlay {

using Vec = exact::Vector3<double>;

// The sign of det(a, b, y). Never zero, unless a and b are on one line with the center.
Sign turned_point_sign(const Point& a, const Point& b, const Point& y);
// The sign of det(x, y, z).
Sign turned_edge_sign(const Point& x, const Point& y, const Point& z);

// The product of p, or of y, with a step between two points, as good as unit vectors: their cross
// product is off by u (1 + 2 sqrt(2)) |step|, and its scalar product with a third one by 3 u |step| more: 6.9 u.
// With a difference d to one of the ends of the step for the third, it is 7.9 u |d|; d is at most 2 long.
inline constexpr double line_bound = 8 * predicates::unit_roundoff;
inline constexpr double edge_bound = 18 * predicates::unit_roundoff;

// At least the length, unless that is so small that products may underflow: then too much for any value.
inline double size_of_step(const Vec& step) {
  constexpr double least_size = 0x1p-400;
  constexpr double too_much = 1e300;
  const double size = std::abs(step.x) + std::abs(step.y) + std::abs(step.z);
  return size > least_size ? size : too_much;
}

// The great circle from p to q, two points that are not turned.
class TracedLine {
 public:
  TracedLine(const Point& p, const Point& q)
      : p_(p), q_(q), step_(exact::to_vector(q) - exact::to_vector(p)) {
    normal_ = cross(exact::to_vector(p), step_);
    limit_ = line_bound * size_of_step(step_);
  }

  // Whether a point of the cover is to the left.
  [[nodiscard]] bool is_left(const Point& y) const {
    const double value = rough_side(y);
    return is_sure(value) ? value > 0 : is_left_nearby(y);
  }
  // The same of one that is as good as on the line: most likely next to an end.
  [[nodiscard]] bool is_left_nearby(const Point& y) const;
  // Positive on the left, negative on the right, if it is_sure().
  [[nodiscard]] double rough_side(const Point& y) const {
    return dot(normal_, exact::to_vector(y));
  }
  [[nodiscard]] bool is_sure(double rough_side) const { return std::abs(rough_side) > limit_; }

  // Whether both points are on one ray from the center: no point is to the left then.
  [[nodiscard]] bool is_point() const {
    constexpr double surely_not = 1e-24;
    return dot(normal_, normal_) < surely_not && is_same_site(p_, q_);
  }

  [[nodiscard]] const Point& from() const { return p_; }
  [[nodiscard]] const Point& to() const { return q_; }
  [[nodiscard]] const Vec& step() const { return step_; }

 private:
  Point p_;
  Point q_;
  Vec step_;
  Vec normal_{};
  double limit_ = 0;
};

// An edge from y to z of the cover.
class CoverEdge {
 public:
  CoverEdge(const Point& y, const Point& z)
      : y_(y), z_(z), step_(exact::to_vector(z) - exact::to_vector(y)) {
    normal_ = cross(exact::to_vector(y), step_);
  }

  // How far x, which is not turned, is to the left of it, times its length.
  [[nodiscard]] double distance(const Point& x) const {
    return dot(normal_, exact::to_vector(x) - exact::to_vector(y_));
  }
  [[nodiscard]] const Point& start() const { return y_; }
  [[nodiscard]] const Point& end() const { return z_; }
  [[nodiscard]] double squared_length() const { return dot(step_, step_); }
  [[nodiscard]] bool is_left(const Point& x) const {
    const double value = distance(x);
    return is_sure(value) ? value > 0 : is_left_nearby(x);
  }
  // Whether x, which is not turned, is on the great circle of the edge as it was before it turned.
  [[nodiscard]] bool is_on_circle(const Point& x) const {
    return !is_sure(distance(x)) && nearby_sign(x) == Sign::zero &&
           orientation(y_, z_, x) == Sign::zero;
  }

 private:
  [[nodiscard]] bool is_sure(double distance) const {
    return std::abs(distance) > edge_bound * size_of_step(step_);
  }
  [[nodiscard]] bool is_left_nearby(const Point& x) const;
  [[nodiscard]] Sign nearby_sign(const Point& x) const;  // zero: not known

  const Point& y_;
  const Point& z_;
  Vec step_;
  Vec normal_{};
};

}  // namespace rondel::overlay
