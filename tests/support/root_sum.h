// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Exact signs of sums of square roots, in two independent ways.
//
// A RootSum over the squares N_0 ... N_3 is the number
//
//     sum over the subsets m of {0, 1, 2, 3} of  c[m] * product of sqrt(N_i), i in m
//
// with integers c[m] and N_i > 0: an element of the extension of degree 16 in which the
// side-of-circle test of projected points lives.
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>

namespace rondel::test {

struct RootSum {
  std::array<mpz_class, 4> squares;
  std::array<mpz_class, 16> c;
};

// The paper's squaring method (section 4.1), applied to one root at a time: the sign of
// A + B*sqrt(N) follows from the signs of A and B or, when they differ, from A^2 - B^2 N.
int sign_by_squaring(const RootSum& sum);

// Floating point at rising precision up to `max_bits` with an error bound; empty when
// the sum may be zero, which no precision can decide.
std::optional<int> sign_by_mpfr(const RootSum& sum, unsigned max_bits = 4096);

// MPFR decides what it can, squaring decides the rest.
int sign(const RootSum& sum);

}  // namespace rondel::test
