// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Exact orientations of the points of two sets of cells. The second set, the cover, is perturbed by
// an infinitesimal rotation, so that no point of one set lies on an edge of the other, and two
// edges cross in the inside of both or not at all. So equal grids, shared corners and shared edges
// are no special cases.
//
// in    points of a set of cells (a, b, x) and of the perturbed cover (y, z)
// out   signs, never zero; rounded values with bounds where a filter is enough
//
// The rotation w = (d, d^1.3, d^1.6), for d that tends to 0, takes y to y + w x y. Where a
// determinant vanishes, its first-order change decides, which is w.v with a vector v that is not
// zero: a (y.b) - b (y.a) for det(a, b, y), and z (x.y) - y (x.z) for det(x, y, z). Its sign is
// that of the first coordinate of v that is not zero, because all terms of second order are
// at most of order d^2.
#pragma once

#include <cmath>

#include "exact/vector.h"
#include "predicates/bounds.h"
#include "rondel/predicates.h"
#include "rondel/types.h"

namespace rondel::overlay {

using Vec = exact::Vector3<double>;

// Returns the sign of det(a, b, y) with y perturbed. It is never zero, unless a and b are on one
// line with the center.
Sign turned_point_sign(const Point& a, const Point& b, const Point& y);
// Returns the sign of det(x, y, z) with y and z perturbed.
Sign turned_edge_sign(const Point& x, const Point& y, const Point& z);

// The bounds of the filters. Let p (or y) and both ends of a step be unit vectors up to rounding.
// The cross product of p and the step is off by u (1 + 2 sqrt(2)) |step|, and its scalar product
// with a third vector by 3 u |step| more: 6.9 u. With a difference d to one of the ends of the step
// for the third vector, it is 7.9 u |d|, and d is at most 2 long.
inline constexpr double line_bound = 8 * predicates::unit_roundoff;
inline constexpr double edge_bound = 18 * predicates::unit_roundoff;

// Returns a bound for the length of a step. If the length is so small that products may underflow,
// the result is too large for any value to exceed the bound, so that the exact rung decides.
inline double size_of_step(const Vec& step) {
  constexpr double min_size = 0x1p-400;
  constexpr double too_much = 1e300;
  const double size = std::abs(step.x) + std::abs(step.y) + std::abs(step.z);
  return size > min_size ? size : too_much;
}

// The great circle from p to q, two points of the cells that are not perturbed.
class TracedLine {
 public:
  TracedLine(const Point& p, const Point& q)
      : p_(p), q_(q), step_(exact::to_vector(q) - exact::to_vector(p)) {
    normal_ = cross(exact::to_vector(p), step_);
    limit_ = line_bound * size_of_step(step_);
  }

  // True if a perturbed point of the cover is to the left.
  [[nodiscard]] bool is_left(const Point& y) const {
    const double value = rough_side(y);
    return is_sure(value) ? value > 0 : is_left_nearby(y);
  }
  // Returns the same for a point so near to the line that the filter leaves it open; most often it
  // is next to an end.
  [[nodiscard]] bool is_left_nearby(const Point& y) const;
  // Returns a value that is positive on the left and negative on the right, if is_sure() of it.
  [[nodiscard]] double rough_side(const Point& y) const {
    return dot(normal_, exact::to_vector(y));
  }
  [[nodiscard]] bool is_sure(double rough_side) const { return std::abs(rough_side) > limit_; }

  // True if both points are on one ray from the center. Then no point is to the left.
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

// An edge of the perturbed cover, from y to z.
class CoverEdge {
 public:
  CoverEdge(const Point& y, const Point& z)
      : y_(y), z_(z), step_(exact::to_vector(z) - exact::to_vector(y)) {
    normal_ = cross(exact::to_vector(y), step_);
  }

  // Returns how far an unperturbed point x is to the left of the edge, times the length of the
  // edge; rounded.
  [[nodiscard]] double scaled_distance(const Point& x) const {
    return dot(normal_, exact::to_vector(x) - exact::to_vector(y_));
  }
  [[nodiscard]] const Point& start() const { return y_; }
  [[nodiscard]] const Point& end() const { return z_; }
  [[nodiscard]] double squared_length() const { return dot(step_, step_); }
  // True if an unperturbed point x is to the left of the perturbed edge.
  [[nodiscard]] bool is_left(const Point& x) const {
    const double value = scaled_distance(x);
    return is_sure(value) ? value > 0 : is_left_nearby(x);
  }
  // True if an unperturbed point x is on the great circle of the edge before the perturbation.
  [[nodiscard]] bool is_on_circle(const Point& x) const {
    return !is_sure(scaled_distance(x)) && nearby_sign(x) == Sign::zero &&
           orientation(y_, z_, x) == Sign::zero;
  }

 private:
  [[nodiscard]] bool is_sure(double distance) const {
    return std::abs(distance) > edge_bound * size_of_step(step_);
  }
  [[nodiscard]] bool is_left_nearby(const Point& x) const;
  [[nodiscard]] Sign nearby_sign(const Point& x) const;  // zero if it is not known

  const Point& y_;
  const Point& z_;
  Vec step_;
  Vec normal_{};
};

}  // namespace rondel::overlay
