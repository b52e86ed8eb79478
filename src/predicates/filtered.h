// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the inexact rungs of a ladder share.
#pragma once

#include <algorithm>
#include <cmath>

#include "exact/vector.h"
#include "predicates/bounds.h"
#include "rondel/types.h"

namespace rondel::predicates {

using exact::sign_of;
using exact::to_vector;
using Vector = exact::Vector3<double>;

// An inexact rung returns the proven sign, or Sign::zero for "unsure"; it never proves a zero.
inline Sign unless_unsure(double value, bool is_proven) {
  return is_proven ? sign_of(value) : Sign::zero;
}

inline double max_squared_length(const Vector& a, const Vector& b, const Vector& c) {
  return std::max(std::max(dot(a, a), dot(b, b)), dot(c, c));
}

// Whether |value| exceeds bound |a||b||c|, given the squared lengths. No where a product could lose
// bits at either end of the range (docs/theory/filters.md).
inline bool is_beyond(double value, double bound, double a2, double b2, double c2) {
  return std::min(std::min(a2, b2), c2) > least_squared_length &&
         value * value > (bound * bound) * ((a2 * b2) * c2);
}

// Whether |value| exceeds the bound times the two largest of |a|, |b| and |c|, given the squared
// lengths. For finite vectors.
inline bool is_beyond_longest(double value, double bound, double a2, double b2, double c2) {
  return value * value > (bound * bound) * std::max(std::max(a2 * b2, b2 * c2), c2 * a2);
}

}  // namespace rondel::predicates
