// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the ladders share. A ladder asks one rung after the other for an exact sign; the first rung
// that is sure decides. Each predicate's ladder is composed once: conflict.h, orientation.h,
// compare_distance.h, within_angle.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "exact/vector.h"
#include "predicates/bounds.h"
#include "predicates/points.h"
#include "rondel/types.h"

namespace rondel::predicates {

using exact::sign_of;
using exact::to_vector;

// From the cheapest to the last.
enum class Rung : std::uint8_t { filter, extended, double_double, close, exact, perturbed };

// An exact sign and the rung that found it.
struct Decision {
  Sign sign = Sign::zero;
  Rung rung = Rung::filter;
};

[[gnu::always_inline]] inline void count(Tally& tally, Rung rung) {
  switch (rung) {
    case Rung::filter:
      ++tally.filter;
      break;
    case Rung::extended:
      ++tally.extended;
      break;
    case Rung::double_double:
      ++tally.double_double;
      break;
    case Rung::close:
      ++tally.close;
      break;
    case Rung::exact:
      ++tally.exact;
      break;
    case Rung::perturbed:
      ++tally.perturbed;
      break;
  }
}

inline void add(Tally& sum, const Tally& tally) {
  sum.filter += tally.filter;
  sum.extended += tally.extended;
  sum.double_double += tally.double_double;
  sum.close += tally.close;
  sum.exact += tally.exact;
  sum.perturbed += tally.perturbed;
}

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
  return std::min(std::min(a2, b2), c2) > min_squared_length &&
         value * value > (bound * bound) * ((a2 * b2) * c2);
}

// Whether |value| exceeds the bound times the two largest of |a|, |b| and |c|, given the squared
// lengths. For finite vectors.
inline bool is_beyond_longest(double value, double bound, double a2, double b2, double c2) {
  return value * value > (bound * bound) * std::max(std::max(a2 * b2, b2 * c2), c2 * a2);
}

}  // namespace rondel::predicates
