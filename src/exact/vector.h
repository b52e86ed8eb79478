// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Vectors of three numbers of any ring: double, double-double, balls, integers. The same is said of
// points, where they stand for their differences from the origin.
#pragma once

#include <algorithm>
#include <cmath>

#include "exact/eft.h"
#include "rondel/types.h"

namespace rondel::exact {

template <class T>
struct Vector3 {
  T x;
  T y;
  T z;
};

template <class V>
concept ThreeNumbers = requires(const V& v) {
  v.x;
  v.y;
  v.z;
};

template <ThreeNumbers V>
V operator-(const V& a, const V& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <ThreeNumbers V>
V operator+(const V& a, const V& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <ThreeNumbers V>
V operator*(double s, const V& v) {
  return {s * v.x, s * v.y, s * v.z};
}

template <ThreeNumbers V>
V operator/(const V& v, double s) {
  return {v.x / s, v.y / s, v.z / s};
}

template <ThreeNumbers V>
auto dot(const V& a, const V& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <ThreeNumbers V>
V cross(const V& a, const V& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// det(a, b, c), the rows of a 3x3 matrix.
template <ThreeNumbers V>
auto det(const V& a, const V& b, const V& c) {
  return dot(a, cross(b, c));
}

// The length, if no square over- or underflows.
template <ThreeNumbers V>
double norm(const V& v) {
  return std::sqrt(dot(v, v));
}

template <ThreeNumbers V>
double largest_coordinate(const V& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// v over its largest coordinate, so that no product over- or underflows; zero stays zero.
template <ThreeNumbers V>
V scaled(const V& v) {
  const double largest = largest_coordinate(v);
  return largest > 0 ? v / largest : v;
}

// v / |v|, but zero stays zero. Precondition: no coordinate above 2^500.
template <ThreeNumbers V>
V normalized(const V& v) {
  const double square = dot(v, v);
  if (!(square < 0x1p-900)) return v / std::sqrt(square);
  return largest_coordinate(v) == 0 ? v : normalized(scaled(v));
}

inline Vector3<double> to_vector(const Point& p) { return {p.x, p.y, p.z}; }
inline Point to_point(const Vector3<double>& v) { return {v.x, v.y, v.z}; }

// a - b, exactly unless it overflows.
inline Vector3<DoubleDouble> difference(const Point& a, const Point& b) {
  return {two_diff(a.x, b.x), two_diff(a.y, b.y), two_diff(a.z, b.z)};
}

inline Sign sign_of(double value) {
  return static_cast<Sign>(static_cast<int>(value > 0) - static_cast<int>(value < 0));
}

}  // namespace rondel::exact

namespace rondel {

// For points.
using exact::operator-;
using exact::operator+;
using exact::operator*;
using exact::operator/;
using exact::cross;
using exact::det;
using exact::dot;
using exact::largest_coordinate;
using exact::norm;
using exact::normalized;
using exact::scaled;

inline Sign operator-(Sign s) { return static_cast<Sign>(-static_cast<int>(s)); }
inline Sign operator*(Sign s, Sign t) {
  return static_cast<Sign>(static_cast<int>(s) * static_cast<int>(t));
}

}  // namespace rondel

namespace rondel::exact {

// Lengths, the same bits on every platform: std::hypot differs between C libraries.
// The length of any vector, whose squares may over- or underflow.
template <ThreeNumbers V>
double length_of(const V& v) {
  return largest_coordinate(v) * norm(scaled(v));
}

}  // namespace rondel::exact
