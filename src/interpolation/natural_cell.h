// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cell that a target u gets from its natural neighbors, in a plane with the origin at u
// (docs/theory/interpolation.md).
//
// in    one bisector for each neighbor, in ring order; for Sibson's method the faces of the
//       conflict region
// out   one share for each neighbor; the weights are the shares over their sum
// index neighbors by their position in the ring (natural_region.h)
//
// Neighbor i bounds the cell by the line g.p_i = s_i:
//
//     gnomonic        p = the tangential part of x - u,           s = |x - u|^2 / 2
//     stereographic   p / (1 - s/2),                              s / (1 - s/2)
//
// The corner v_i of the cell lies on the lines of i and i+1. The Voronoi vertex w of a face (a, b,
// c) of the diagram without u satisfies w.(p_b - p_a) = s_b - s_a and w.(p_c - p_a) = s_c - s_a.
//
// T is a double, a DoubleDouble or a Ball. Any two perpendicular tangent vectors at u of equal
// length serve as a basis of the plane: a common factor of all p scales the plane and changes no
// ratio.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "exact/ball.h"
#include "exact/eft.h"
#include "exact/vector.h"
#include "interpolation/natural_region.h"

namespace rondel::interpolation {

// Returns an approximation of the number as a double.
inline double leading(double a) { return a; }
inline double leading(const exact::DoubleDouble& a) { return a.hi; }

inline double quotient(double a, double b) { return a / b; }
// The relative error is 2^-100: after the first quotient, a - q b is known to 2^-105 a.
inline exact::DoubleDouble quotient(const exact::DoubleDouble& a, const exact::DoubleDouble& b) {
  const double q = a.hi / b.hi;
  const double rest = (a - b * q).hi / b.hi;
  return exact::fast_two_sum(q, rest);
}

template <std::size_t N>
double leading(const exact::Ball<N>& a) {
  if (a.size_of_midpoint() == exact::nothing) return 0;
  const double size = std::ldexp(static_cast<double>(a.leading()), a.size_of_midpoint() - 64);
  return a.midpoint().sign() == Sign::negative ? -size : size;
}

// If the divisor may be zero, the result is a ball that contains everything.
template <std::size_t N>
exact::Ball<N> quotient(const exact::Ball<N>& a, const exact::Ball<N>& b) {
  constexpr exact::Magnitude unknown = 1 << 20;
  const bool is_negative = b.midpoint().sign() == Sign::negative;
  const auto root = exact::inverse_square_root(is_negative ? -b : b);
  if (!root) return exact::Ball<N>().wider_by(unknown);
  const exact::Ball<N> r = a * (*root * *root);
  return is_negative ? -r : r;
}

inline double half(double a) { return 0.5 * a; }
inline exact::DoubleDouble half(const exact::DoubleDouble& a) { return {0.5 * a.hi, 0.5 * a.lo}; }
template <std::size_t N>
exact::Ball<N> half(const exact::Ball<N>& a) {
  return a.times_power_of_two(-1);
}

// A point of the tangent plane.
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

// The line g.p = s between the target and a neighbor.
template <class T>
struct Bisector {
  Planar<T> p;
  T s;
  double size = 0;  // |p|, approximately
};

// A basis of the tangent plane at u: with `axis` the smallest coordinate of u, the vectors axis x u
// and u x (axis x u), which are equally long after scaling.
class TangentBasis {
 public:
  explicit TangentBasis(const Point& u) {
    const std::array<double, 3> size = {std::abs(u.x), std::abs(u.y), std::abs(u.z)};
    if (size[1] < size[axis_]) axis_ = 1;
    if (size[2] < size[axis_]) axis_ = 2;
  }

  // Returns the bisector of u and the site u + d in the gnomonic plane. Since u.d = -s, the part of
  // d along u is -s u.
  template <class T>
  [[nodiscard]] Bisector<T> bisector(const exact::Vector3<T>& u, const exact::Vector3<T>& d) const {
    const T s = half(dot(d, d));
    const auto [ui, uj, uk] = turned(u);
    const auto [di, dj, dk] = turned(d);
    const Planar<T> p = {uj * dk - uk * dj, di + ui * s};
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

// Changes bisectors of the gnomonic plane to those of the stereographic plane.
template <class T>
void make_stereographic(std::span<Bisector<T>> bisectors) {
  for (Bisector<T>& b : bisectors) {
    const T rest = T{1} - half(b.s);
    b = {{quotient(b.p.x, rest), quotient(b.p.y, rest)}, quotient(b.s, rest), 0};
    b.size = size_of(b.p) / leading(rest);
  }
}

template <class T>
class NaturalCell {
 public:
  std::vector<Bisector<T>>& bisectors() { return bisectors_; }

  // laplace() and sibson() compute the shares. They return an estimate of the error of a weight, in
  // units of the relative error of the bisectors; infinity if the cell may be unbounded, as far as
  // T can tell.

  // The share is L_i / |p_i|, where L_i is the length of the side on line i: p_i x (v_i - v_{i-1})
  // / |p_i|^2.
  double laplace();
  // The share is twice the area that the new cell takes from the cell of neighbor i.
  double sibson(std::span<const RegionFace> faces);

  // Returns the share of each neighbor. The weights are the shares over their sum.
  [[nodiscard]] const std::vector<T>& shares() const { return shares_; }

 private:
  struct CellCorner {
    Planar<T> at;
    double error = 0;
  };

  [[nodiscard]] static CellCorner corner(const Bisector<T>& a, const Bisector<T>& b);
  [[nodiscard]] static CellCorner vertex(const Bisector<T>& a, const Bisector<T>& b,
                                         const Bisector<T>& c);
  void make_corners();
  [[nodiscard]] std::size_t after(std::size_t i) const {
    return i + 1 < bisectors_.size() ? i + 1 : 0;
  }
  [[nodiscard]] std::size_t before(std::size_t i) const {
    return (i > 0 ? i : bisectors_.size()) - 1;
  }
  // Moves the area of the triangle of the origin, `from` and `to` from the share of `giver` to that
  // of `sink`.
  void move(const Planar<T>& from, const Planar<T>& to, std::size_t sink, std::size_t giver) {
    const T area = cross(from, to);
    shares_[sink] = shares_[sink] + area;
    shares_[giver] = shares_[giver] - area;
  }

  std::vector<Bisector<T>> bisectors_;
  std::vector<CellCorner> corners_;
  std::vector<CellCorner> vertices_;
  std::vector<T> shares_;
};

template <class T>
auto NaturalCell<T>::corner(const Bisector<T>& a, const Bisector<T>& b) -> CellCorner {
  const T d = cross(a.p, b.p);
  const Planar<T> v = {quotient(a.s * b.p.y - b.s * a.p.y, d),
                       quotient(b.s * a.p.x - a.s * b.p.x, d)};
  const double error =
      leading(a.s) * b.size + leading(b.s) * a.size + size_of(v) * (a.size * b.size);
  return {v, error / std::max(leading(d), 0.0)};
}

template <class T>
auto NaturalCell<T>::vertex(const Bisector<T>& a, const Bisector<T>& b, const Bisector<T>& c)
    -> CellCorner {
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
void NaturalCell<T>::make_corners() {
  const std::size_t size = bisectors_.size();
  corners_.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    corners_[i] = corner(bisectors_[i], bisectors_[after(i)]);
  }
}

template <class T>
double NaturalCell<T>::laplace() {
  make_corners();
  const std::size_t size = bisectors_.size();
  shares_.resize(size);
  double sum = 0;
  double error = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Bisector<T>& own = bisectors_[i];
    const CellCorner& last = corners_[before(i)];
    const CellCorner& next = corners_[i];
    const T square = own.p.x * own.p.x + own.p.y * own.p.y;
    shares_[i] = quotient(cross(own.p, next.at - last.at), square);
    sum += leading(shares_[i]);
    error += (last.error + next.error + size_of(last.at) + size_of(next.at)) / own.size;
  }
  return error / std::max(sum, 0.0);
}

template <class T>
double NaturalCell<T>::sibson(std::span<const RegionFace> faces) {
  make_corners();
  const std::size_t size = bisectors_.size();
  vertices_.resize(faces.size());
  shares_.resize(size);
  double error = 0;
  double radius = 0;
  double total = 0;
  for (std::size_t i = 0; i < size; ++i) {
    shares_[i] = cross(corners_[before(i)].at, corners_[i].at);
    total += leading(shares_[i]);
    error += corners_[i].error;
    radius = std::max(radius, size_of(corners_[i].at));
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
  return (error + radius) * radius / std::max(total, 0.0);
}

}  // namespace rondel::interpolation
