// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Vectors of three numbers of any ring: double, double-double, balls, integers.
#pragma once

#include "exact/eft.h"
#include "rondel/types.h"

namespace rondel::exact {

template <class T>
struct Vector3 {
  T x;
  T y;
  T z;
};

template <class T>
Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class T>
Vector3<T> operator+(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// det(a, b, c), the rows of a 3x3 matrix.
template <class T>
T det(const Vector3<T>& a, const Vector3<T>& b, const Vector3<T>& c) {
  return dot(a, cross(b, c));
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

inline Sign operator-(Sign s) { return static_cast<Sign>(-static_cast<int>(s)); }
inline Sign operator*(Sign s, Sign t) {
  return static_cast<Sign>(static_cast<int>(s) * static_cast<int>(t));
}

}  // namespace rondel
