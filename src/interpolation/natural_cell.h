// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cell that a target u gets from its natural neighbors, in a plane with u in the origin
// (docs/theory/interpolation.md). Neighbor i bounds it by the line g.p_i = s_i:
//
//     gnomonic        p = the tangential part of x - u,           s = |x - u|^2 / 2
//     stereographic   p / (1 - s/2),                              s / (1 - s/2)
//
// Its corner v_i lies on the lines of i and i+1. The vertex w that the diagram had before for a face
// (a, b, c) fulfills w.(p_b - p_a) = s_b - s_a and w.(p_c - p_a) = s_c - s_a.
//
// T is a double or a DoubleDouble. Any two vectors across u serve as a basis of the plane if they are
// perpendicular and equally long: a factor of all p divides all of the plane, and ratios stay.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "exact/eft.h"
#include "exact/vector.h"
#include "interpolation/natural_region.h"

namespace rondel::interpolation {

inline double leading(double a) { return a; }
inline double leading(const exact::DoubleDouble& a) { return a.hi; }

inline double quotient(double a, double b) { return a / b; }
// To a relative 2^-100: after the first quotient, a - q b is known to 2^-105 a.
inline exact::DoubleDouble quotient(const exact::DoubleDouble& a, const exact::DoubleDouble& b) {
  const double q = a.hi / b.hi;
  const double rest = (a - b * q).hi / b.hi;
  return exact::fast_two_sum(q, rest);
}

template <class T>
T number(double value) {
  return T{value};
}

// A point of the plane.
template <class T>
struct Planar {
  T x;
  T y;
};
template <class T>
T cross(const Planar<T>& a, const Planar<T>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class T>
Planar<T> operator-(const Planar<T>& a, const Planar<T>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <class T>
double size_of(const Planar<T>& a) {
  return std::abs(leading(a.x)) + std::abs(leading(a.y));
}

template <class T>
struct Bisector {
  Planar<T> p;
  T s;
  double size = 0;  // of p
};

// Coordinates in the plane across u, whose coordinate `axis` is the smallest: along axis x u and, the
// other way, u x (axis x u), which are equally long.
class TangentBasis {
 public:
  explicit TangentBasis(const Point& u) {
    const std::array<double, 3> size = {std::abs(u.x), std::abs(u.y), std::abs(u.z)};
    if (size[1] < size[axis_]) axis_ = 1;
    if (size[2] < size[axis_]) axis_ = 2;
  }

  // Of the step d from u to a site. u.d = -s, so that the part of d along u is -s u. `shrink`: d is
  // given divided by it, and so is what comes back.
  template <class T>
  [[nodiscard]] Bisector<T> bisector(const exact::Vector3<T>& u, const exact::Vector3<T>& d,
                                     double shrink = 1) const {
    const T s = dot(d, d) * 0.5;
    const auto [ui, uj, uk] = turned(u);
    const auto [di, dj, dk] = turned(d);
    const Planar<T> p = {uj * dk - uk * dj, di + ui * s * shrink};
    return {p, s, size_of(p)};
  }

 private:
  template <class T>
  [[nodiscard]] exact::Vector3<T> turned(const exact::Vector3<T>& v) const {
    if (axis_ == 0) return v;
    if (axis_ == 1) return {v.y, v.z, v.x};
    return {v.z, v.x, v.y};
  }

  std::size_t axis_ = 0;
};

// The same in the stereographic plane.
template <class T>
void make_stereographic(std::span<Bisector<T>> bisectors, double shrink = 1) {
  for (Bisector<T>& b : bisectors) {
    const T rest = number<T>(1) - b.s * (0.5 * shrink * shrink);
    b = {{quotient(b.p.x, rest), quotient(b.p.y, rest)}, quotient(b.s, rest), 0};
    b.size = size_of(b.p) / leading(rest);
  }
}

// Shares that are not divided by their sum yet, and an estimate of the error of a share over the sum,
// in units of the relative error of what they are made of.
struct Condition {
  double value = std::numeric_limits<double>::infinity();
};

template <class T>
class NaturalCell {
 public:
  std::vector<Bisector<T>>& bisectors() { return bisectors_; }

  // L_i / |p_i|, L_i being the length of the side on line i:
  //
  //     s_{i-1} D_{i,i+1} + s_i D_{i+1,i-1} + s_{i+1} D_{i-1,i}
  //     ---------------------------------------------------------,    D_ij = p_i x p_j.
  //                     D_{i-1,i} D_{i,i+1}
  //
  // Empty shares mean that the ring does not wind around u, as far as T can tell.
  Condition laplace(std::vector<double>& shares);

  // The areas of what the cell takes from those of the neighbors, twice.
  Condition sibson(std::span<const RegionFace> faces, std::vector<double>& shares);

 private:
  struct Corner {
    Planar<T> at;
    double error = 0;
  };

  [[nodiscard]] static Corner corner(const Bisector<T>& a, const Bisector<T>& b);
  [[nodiscard]] static Corner vertex(const Bisector<T>& a, const Bisector<T>& b,
                                     const Bisector<T>& c);
  // The area between the origin and the edge from one vertex to another goes from one cell to another.
  void move(const Planar<T>& from, const Planar<T>& to, std::size_t taker, std::size_t giver) {
    const T area = cross(from, to);
    areas_[taker] = areas_[taker] + area;
    areas_[giver] = areas_[giver] - area;
  }

  std::vector<Bisector<T>> bisectors_;
  std::vector<Corner> corners_;
  std::vector<Corner> vertices_;
  std::vector<T> areas_;
};

template <class T>
auto NaturalCell<T>::corner(const Bisector<T>& a, const Bisector<T>& b) -> Corner {
  const T d = cross(a.p, b.p);
  const Planar<T> v = {quotient(a.s * b.p.y - b.s * a.p.y, d),
                       quotient(b.s * a.p.x - a.s * b.p.x, d)};
  const double error =
      leading(a.s) * b.size + leading(b.s) * a.size + size_of(v) * (a.size * b.size);
  return {v, error / std::max(leading(d), 0.0)};
}

template <class T>
auto NaturalCell<T>::vertex(const Bisector<T>& a, const Bisector<T>& b, const Bisector<T>& c)
    -> Corner {
  const Planar<T> to_b = b.p - a.p;
  const Planar<T> to_c = c.p - a.p;
  const T sb = b.s - a.s;
  const T sc = c.s - a.s;
  const T d = cross(to_b, to_c);
  const Planar<T> w = {quotient(sb * to_c.y - sc * to_b.y, d),
                       quotient(sc * to_b.x - sb * to_c.x, d)};
  const double size = std::max({a.size, b.size, c.size});
  return {w, size * size * (size + size_of(w)) / std::max(leading(d), 0.0)};
}

template <class T>
Condition NaturalCell<T>::laplace(std::vector<double>& shares) {
  const std::size_t size = bisectors_.size();
  shares.clear();
  double sum = 0;
  double error = 0;
  const Bisector<T>* before = &bisectors_[size - 1];
  const Bisector<T>* here = bisectors_.data();
  T d_before = cross(before->p, here->p);
  for (std::size_t i = 0; i < size; ++i) {
    const Bisector<T>* after = &bisectors_[i + 1 < size ? i + 1 : 0];
    const T d_after = cross(here->p, after->p);
    if (!(leading(d_after) > 0)) return {};
    const T in_circle = before->s * d_after + here->s * cross(after->p, before->p) +
                        after->s * d_before;
    const double product = leading(d_before) * leading(d_after);
    const double share = leading(in_circle) / product;
    const double size_before = before->size * here->size;
    const double size_after = here->size * after->size;
    error += (leading(before->s) * size_after + leading(here->s) * (after->size * before->size) +
              leading(after->s) * size_before) /
                 product +
             std::abs(share) * (size_before / leading(d_before) + size_after / leading(d_after));
    sum += share;
    shares.push_back(share);
    before = here;
    here = after;
    d_before = d_after;
  }
  return {error / sum};
}

template <class T>
Condition NaturalCell<T>::sibson(std::span<const RegionFace> faces, std::vector<double>& shares) {
  const std::size_t size = bisectors_.size();
  corners_.resize(size);
  vertices_.resize(faces.size());
  areas_.assign(size, number<T>(0));
  double error = 0;
  double radius = 0;
  for (std::size_t i = 0; i < size; ++i) {
    corners_[i] = corner(bisectors_[i], bisectors_[i + 1 < size ? i + 1 : 0]);
    error += corners_[i].error;
    radius = std::max(radius, size_of(corners_[i].at));
  }
  T total = number<T>(0);
  for (std::size_t i = 0; i < size; ++i) {
    areas_[i] = cross(corners_[i > 0 ? i - 1 : size - 1].at, corners_[i].at);
    total = total + areas_[i];
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& [a, apex, end, parent] = faces[f];
    const std::size_t b = end < size ? end : 0;
    vertices_[f] = vertex(bisectors_[a], bisectors_[apex], bisectors_[b]);
    error += vertices_[f].error;
    const Planar<T>& w = vertices_[f].at;
    move(parent == no_index ? corners_[0].at : vertices_[parent].at, w, b, a);
    if (apex == a + 1) move(corners_[a].at, w, a, apex);
    if (end == apex + 1) move(corners_[apex].at, w, apex, b);
  }
  shares.clear();
  for (const T& area : areas_) shares.push_back(leading(area));
  return {(error + radius) * radius / std::max(leading(total), 0.0)};
}

}  // namespace rondel::interpolation
