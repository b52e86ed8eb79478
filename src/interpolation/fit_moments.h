// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The second part of a local fit: the moments, which are sums over the neighbors of weight a^i b^j.
// The entries of the normal equations are some of them.
//
// in    for each lane coordinates (a, b) and weights of the neighbors
// out   for each lane the moments of degrees 2 to 7
// index moments: by degree, and then by the power of b
#pragma once

#include <cstddef>
#include <utility>

#include "interpolation/fit_lanes.h"
#include "interpolation/settled_fit.h"

namespace rondel::interpolation::fits {

// Returns the index of the first moment of degree s, that of a^s.
RONDEL_ALWAYS_INLINE constexpr std::size_t first_of(std::size_t s) { return (s * (s + 1)) / 2 - 3; }
inline constexpr std::size_t num_moments = first_of(8);
static_assert(num_moments == num_fit_moments);

// Returns the index of the moment of the product of two terms.
RONDEL_ALWAYS_INLINE constexpr std::size_t moment_of(std::size_t i, std::size_t j) {
  return first_of(degrees[i] + degrees[j]) + powers_of_b[i] + powers_of_b[j];
}

// The products of one neighbor, in the order of the moments.
using Products = system::PlainArray<double, num_moments>;

// Computes the products of degree s from those of degree s - 1.
template <std::size_t S, std::size_t... Q>
RONDEL_ALWAYS_INLINE inline void raise(double a, double b, std::index_sequence<Q...> /*powers*/,
                                       Products& products) {
  ((products[first_of(S) + Q] = products[first_of(S - 1) + Q] * a), ...);
  products[first_of(S) + S] = products[first_of(S - 1) + S - 1] * b;
}

// Returns weight a^(s-q) b^q of one neighbor, for s = 2 ... 7.
RONDEL_ALWAYS_INLINE inline Products products_of(double weight, double a, double b) {
  Products products;
  products[0] = weight * (a * a);
  products[1] = weight * (a * b);
  products[2] = weight * (b * b);
  raise<3>(a, b, std::make_index_sequence<3>(), products);
  raise<4>(a, b, std::make_index_sequence<4>(), products);
  raise<5>(a, b, std::make_index_sequence<5>(), products);
  raise<6>(a, b, std::make_index_sequence<6>(), products);
  raise<7>(a, b, std::make_index_sequence<7>(), products);
  return products;
}

// The sums of these products, in all lanes.
using Moments = system::PlainArray<Lanes, num_moments>;

// Changes the points to the coordinates that make their cloud round and sums up their moments.
RONDEL_ALWAYS_INLINE inline void add_moments(const Fit& fit, Moments& moments) {
  const auto add =
      [&moments]<std::size_t... M>(std::size_t i, const Products& p, const Products& q,
                                   std::index_sequence<M...> /*all*/) RONDEL_ALWAYS_INLINE {
    ((moments[M][i] += p[M] + q[M]), ...);
  };
  for (std::size_t k = 0; k < fit.size; k += 2) {
    LaneVectors& p = fit.points[k];
    LaneVectors& q = fit.points[k + 1];
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      p.y[i] = fit.round_b[i] * (p.y[i] - fit.shear[i] * p.x[i]);
      p.x[i] = fit.round_a[i] * p.x[i];
      q.y[i] = fit.round_b[i] * (q.y[i] - fit.shear[i] * q.x[i]);
      q.x[i] = fit.round_a[i] * q.x[i];
    }
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      add(i, products_of(p.z[i], p.x[i], p.y[i]), products_of(q.z[i], q.x[i], q.y[i]),
          std::make_index_sequence<num_moments>());
    }
  }
}

}  // namespace rondel::interpolation::fits
