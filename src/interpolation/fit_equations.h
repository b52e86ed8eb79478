// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The third part of a local fit: solves the normal equations for two polynomials, whose values at
// the neighbors are the weights of the slopes along each axis.
//
// in    for each lane the moments, and the number of neighbors
// out   for each lane the coefficients of two polynomials, and how many terms they have
// index lanes; terms of the polynomials, by degree
#pragma once

#include <cstddef>

#include "interpolation/fit_lanes.h"

namespace rondel::interpolation::fits {

// The least number of neighbors for a linear, quadratic and cubic fit: one or two more than it has
// terms, so that no pair of close sites decides the result.
inline constexpr system::PlainArray<double, 3> min_neighbors = {2, 6, 11};

// The normal equations for the weights of the slopes along a' and b', which have one left side, and
// their factors.
struct Solution {
  system::PlainArray<Terms, max_terms> rows;
  Terms diagonal;
  Terms of_pivots;  // reciprocals of the pivots, 0 for those that are too small
  Terms by_a{};
  Terms by_b{};
};

// Factors the left side: afterwards rows[i][j], j < i, are the entries of L, with a column of zeros
// where the pivot is too small. The right sides e_0 and e_1 are replaced by L^-1 times them.
RONDEL_ALWAYS_INLINE inline void factor(Solution& s) {
  for (std::size_t j = 0; j < max_terms; ++j) {
    RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
      const double pivot = s.rows[j][j][l];
      const double reciprocal = 1 / pivot;
      s.of_pivots[j][l] = pivot > LocalFits::min_pivot * s.diagonal[j][l] ? reciprocal : 0.0;
    }
    for (std::size_t i = max_terms; --i > j;) {
      Lanes factors;
      RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) factors[l] =
          s.rows[i][j][l] * s.of_pivots[j][l];
      for (std::size_t k = j + 1; k <= i; ++k) {
        RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) s.rows[i][k][l] -=
            factors[l] * s.rows[k][j][l];
      }
      RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
        s.rows[i][j][l] = factors[l];
        s.by_a[i][l] -= factors[l] * s.by_a[j][l];
        s.by_b[i][l] -= factors[l] * s.by_b[j][l];
      }
    }
  }
}

// Keeps the terms up to the highest degree all of whose pivots are large enough, and solves for
// these.
RONDEL_ALWAYS_INLINE inline void keep_terms(Fit& fit, Solution& s) {
  constexpr auto linear = static_cast<double>(LocalFits::terms_of_degree[0]);
  constexpr auto quadratic = static_cast<double>(LocalFits::terms_of_degree[1]);
  constexpr auto cubic = static_cast<double>(LocalFits::terms_of_degree[2]);
  RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
    const double most = fit.counts[l] >= min_neighbors[1] ? quadratic : linear;
    fit.num_terms[l] = fit.counts[l] >= min_neighbors[2] ? cubic : most;
    fit.is_found[l] = fit.counts[l] >= min_neighbors[0] ? fit.is_found[l] : 0.0;
  }
  for (std::size_t i = max_terms; i-- > LocalFits::terms_of_degree[0];) {
    const double before = i < LocalFits::terms_of_degree[1] ? linear : quadratic;
    RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
      const double most = smaller(fit.num_terms[l], before);
      fit.num_terms[l] = s.of_pivots[i][l] != 0 ? fit.num_terms[l] : most;
    }
  }
  for (std::size_t i = 0; i < max_terms; ++i) {
    const auto term = static_cast<double>(i);
    RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
      const double factor = term < fit.num_terms[l] ? s.of_pivots[i][l] : 0.0;
      s.by_a[i][l] *= factor;
      s.by_b[i][l] *= factor;
    }
  }
  for (std::size_t i = max_terms; i-- > 0;) {
    for (std::size_t k = 0; k < i; ++k) {
      RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
        s.by_a[k][l] -= s.rows[i][k][l] * s.by_a[i][l];
        s.by_b[k][l] -= s.rows[i][k][l] * s.by_b[i][l];
      }
    }
  }
}

// Returns the sum of c_t times term t at (a, b).
RONDEL_ALWAYS_INLINE inline double polynomial(const Terms& c, std::size_t lane, double a,
                                              double b) {
  const double linear = c[0][lane] * a + c[1][lane] * b;
  const double quadratic = c[2][lane] * (a * a) + c[3][lane] * (a * b) + c[4][lane] * (b * b);
  const double cubic =
      (a * a) * (c[5][lane] * a + c[6][lane] * b) + (b * b) * (c[7][lane] * a + c[8][lane] * b);
  return (linear + quadratic) + cubic;
}

}  // namespace rondel::interpolation::fits
