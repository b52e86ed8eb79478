// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Expansions: exact real numbers as sums of doubles (Shewchuk, Discrete Comput.
// Geom. 18, 1997). The components are sorted by increasing magnitude and
// non-overlapping, none is zero, so the last one gives the sign.
//
// The capacity is part of the type: a sum of N and M components has at most N + M, a
// product at most 2NM. Preconditions as in eft.h for each product of components.
#pragma once

#include "exact/eft.h"
#include "rondel/types.h"

namespace rondel::exact {

template <int N>
struct Expansion {
  double component[N];  // only the first `size` are set
  int size = 0;

  void push(double value) {
    if (value != 0) component[size++] = value;
  }
};

inline Expansion<1> expansion(double a) {
  Expansion<1> e;
  e.component[0] = a;
  e.size = a != 0 ? 1 : 0;
  return e;
}

inline Expansion<2> expansion(DoubleDouble a) {
  if (a.lo == 0) return {{a.hi, 0}, a.hi != 0 ? 1 : 0};
  return {{a.lo, a.hi}, 2};
}

template <int N>
Sign sign_of(const Expansion<N>& e) {
  if (e.size == 0) return Sign::zero;
  return e.component[e.size - 1] > 0 ? Sign::positive : Sign::negative;
}

template <int N>
Expansion<N> operator-(const Expansion<N>& e) {
  Expansion<N> r;
  for (int i = 0; i < e.size; ++i) r.component[i] = -e.component[i];
  r.size = e.size;
  return r;
}

// Shewchuk's FAST-EXPANSION-SUM with zero elimination: merge by magnitude, then one
// sweep of error-free additions.
template <int N, int M>
Expansion<N + M> operator+(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<N + M> r;
  int i = 0;
  int j = 0;
  const auto next = [&] {
    if (j == f.size) return e.component[i++];
    if (i == e.size) return f.component[j++];
    return std::abs(e.component[i]) < std::abs(f.component[j]) ? e.component[i++]
                                                               : f.component[j++];
  };
  if (e.size + f.size == 0) return r;
  double q = next();
  for (int k = 1; k < e.size + f.size; ++k) {
    const DoubleDouble s = two_sum(q, next());
    r.push(s.lo);
    q = s.hi;
  }
  r.push(q);
  return r;
}

template <int N, int M>
Expansion<N + M> operator-(const Expansion<N>& e, const Expansion<M>& f) {
  return e + (-f);
}

// Shewchuk's SCALE-EXPANSION with zero elimination.
template <int N>
Expansion<2 * N> operator*(const Expansion<N>& e, double b) {
  Expansion<2 * N> r;
  if (e.size == 0 || b == 0) return r;
  DoubleDouble q = two_product(e.component[0], b);
  r.push(q.lo);
  for (int i = 1; i < e.size; ++i) {
    const DoubleDouble t = two_product(e.component[i], b);
    const DoubleDouble s = two_sum(q.hi, t.lo);
    r.push(s.lo);
    q = fast_two_sum(t.hi, s.hi);
    r.push(q.lo);
  }
  r.push(q.hi);
  return r;
}

// Adds scaled copies of e, one for each component of f.
template <int N, int M>
Expansion<2 * N * M> operator*(const Expansion<N>& e, const Expansion<M>& f) {
  if constexpr (M == 1) {
    return e * (f.size == 0 ? 0.0 : f.component[0]);
  } else {
    Expansion<2 * N * M> sum;
    for (int j = 0; j < f.size; ++j) {
      const auto longer = sum + e * f.component[j];
      for (int i = 0; i < longer.size; ++i) sum.component[i] = longer.component[i];
      sum.size = longer.size;
    }
    return sum;
  }
}

// Rows of Expansion<N>; the result has at most 24 N^3 components.
template <int N>
auto det(const Expansion<N> (&a)[3], const Expansion<N> (&b)[3], const Expansion<N> (&c)[3]) {
  const auto minor = [&](int j, int k) { return b[j] * c[k] - b[k] * c[j]; };
  return (minor(1, 2) * a[0] + minor(2, 0) * a[1]) + minor(0, 1) * a[2];
}

}  // namespace rondel::exact
