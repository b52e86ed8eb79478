// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Error-free transformations of IEEE double arithmetic and double-double numbers
// (Dekker, Numer. Math. 18, 1971; Shewchuk, Discrete Comput. Geom. 18, 1997).
//
// A transformation returns a pair (hi, lo) with hi the rounded result and hi + lo the
// exact one. Precondition everywhere: no overflow; for products also no underflow, that
// is |a*b| is 0 or above 2^-960, and |a|, |b| < 2^990. The proofs need round to
// nearest and no contraction of a*b+c (-ffp-contract=off).
#pragma once

#include <cmath>
#include <limits>

namespace rondel::exact {

// An unevaluated sum with |lo| <= ulp(hi)/2.
struct DoubleDouble {
  double hi = 0;
  double lo = 0;
};

inline DoubleDouble two_sum(double a, double b) {
  const double s = a + b;
  const double bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

// Precondition: |a| >= |b| or a == 0.
inline DoubleDouble fast_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

// Adds a term to a sum and its error so far. A sum of many terms that cancel is as good as one in twice the precision.
inline void add_term(double term, DoubleDouble& sum) {
  const DoubleDouble next = two_sum(sum.hi, term);
  sum = {next.hi, sum.lo + next.lo};
}

inline DoubleDouble two_diff(double a, double b) { return two_sum(a, -b); }

// Veltkamp's splitting: a = hi + lo, each with at most 26 bits.
inline DoubleDouble split(double a) {
  constexpr double splitter = 134217729.0;  // 2^27 + 1
  const double c = splitter * a;
  const double hi = c - (c - a);
  return {hi, a - hi};
}

inline DoubleDouble two_product(double a, double b) {
  const double p = a * b;
  const DoubleDouble x = split(a);
  const DoubleDouble y = split(b);
  return {p, ((x.hi * y.hi - p) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

inline DoubleDouble two_square(double a) {
  const double p = a * a;
  const DoubleDouble x = split(a);
  return {p, ((x.hi * x.hi - p) + 2 * (x.hi * x.lo)) + x.lo * x.lo};
}

inline DoubleDouble operator-(DoubleDouble a) { return {-a.hi, -a.lo}; }

// Relative error at most 3 * 2^-106 (accurate addition; Joldes, Muller and
// Popescu, ACM TOMS 44, 2017, theorem 3.1).
inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble s = two_sum(a.hi, b.hi);
  const DoubleDouble t = two_sum(a.lo, b.lo);
  const DoubleDouble v = fast_two_sum(s.hi, s.lo + t.hi);
  return fast_two_sum(v.hi, t.lo + v.lo);
}

inline DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + (-b); }

// Relative error at most 7 * 2^-106.
inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = two_product(a.hi, b.hi);
  return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

inline DoubleDouble operator*(DoubleDouble a, double b) {
  const DoubleDouble p = two_product(a.hi, b);
  return fast_two_sum(p.hi, p.lo + a.lo * b);
}

// Numbers with 64 bits: about as fast as doubles where the processor has them.

// 2^-64.
inline constexpr long double extended_unit_roundoff = 0x1p-64L;

// Whether long double rounds to 64 bits. Not so where it is another type, where the processor is
// set to fewer bits, and in some emulators.
inline bool has_extended_precision() {
  static const bool result = [] {
    if constexpr (std::numeric_limits<long double>::digits != 64) return false;
    const volatile long double one = 1;
    const volatile long double unit = 2 * extended_unit_roundoff;
    return one + unit != one;
  }();
  return result;
}

}  // namespace rondel::exact
