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

#include "exact/vector.h"
#include "predicates/bounds.h"
#include "predicates/rung.h"
#include "rondel/predicates.h"
#include "rondel/types.h"

namespace rondel::overlay {

using Vec = exact::Vector3<double>;

// The sign of det(a, b, y). Never zero, unless a and b are on one line with the center.
Sign turned_point_sign(const Point& a, const Point& b, const Point& y);
// The sign of det(x, y, z).
Sign turned_edge_sign(const Point& x, const Point& y, const Point& z);

// The great circle from p to q, two points that are not turned.
class TracedLine {
 public:
  TracedLine(const Point& p, const Point& q)
      : p_(p), q_(q), step_(exact::to_vector(q) - exact::to_vector(p)) {
    normal_ = cross(exact::to_vector(p), step_);
    const double square = dot(step_, step_);
    limit_ = square > predicates::least_squared_length
                 ? bound * bound * dot(exact::to_vector(p), exact::to_vector(p)) * square
                 : too_much;
  }

  // Whether a point of the cover is to the left.
  [[nodiscard]] bool is_left(const Point& y) const {
    const Vec from = exact::to_vector(y) - exact::to_vector(p_);
    const double value = dot(normal_, from);
    const double square = dot(from, from);
    if (value * value > limit_ * square && square > predicates::least_squared_length) {
      return value > 0;
    }
    return turned_point_sign(p_, q_, y) == Sign::positive;
  }

  // Whether both points are on one ray from the center: no point is to the left then.
  [[nodiscard]] bool is_point() const {
    constexpr double surely_not = 1e-24;
    return dot(normal_, normal_) < surely_not && is_same_site(p_, q_);
  }

  [[nodiscard]] const Point& from() const { return p_; }
  [[nodiscard]] const Point& to() const { return q_; }
  [[nodiscard]] const Vec& step() const { return step_; }

 private:
  static constexpr double bound = predicates::orientation_bound;
  static constexpr double too_much = 1e300;

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
  [[nodiscard]] double distance(const Point& x) const { return dot(normal_, from(x)); }
  [[nodiscard]] const Point& start() const { return y_; }
  [[nodiscard]] const Point& end() const { return z_; }
  [[nodiscard]] double squared_length() const { return dot(step_, step_); }
  [[nodiscard]] bool is_left(const Point& x) const {
    const Vec from = this->from(x);
    const double value = dot(normal_, from);
    const double ray_square = dot(exact::to_vector(y_), exact::to_vector(y_));
    if (predicates::is_beyond(value, predicates::orientation_bound, ray_square, dot(step_, step_),
                              dot(from, from))) {
      return value > 0;
    }
    return turned_edge_sign(x, y_, z_) == Sign::positive;
  }

 private:
  [[nodiscard]] Vec from(const Point& x) const {
    return exact::to_vector(x) - exact::to_vector(y_);
  }

  const Point& y_;
  const Point& z_;
  Vec step_;
  Vec normal_{};
};

}  // namespace rondel::overlay
