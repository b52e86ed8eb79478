// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Types that the parts of local fits (local_fit.h) share: the data of the sites in all lanes. The
// functions in fit_*.h are inlined into LocalFits::find(), which is compiled for vectors of several
// widths.
//
// index lanes, each with one site; terms of polynomials, by degree and then by the power of b
#pragma once

#include <cstddef>

#include "interpolation/local_fit.h"
#include "system/wide_vectors.h"

namespace rondel::interpolation::fits {

inline constexpr std::size_t lanes = LocalFits::lanes;
inline constexpr std::size_t max_terms = LocalFits::max_terms;
using Lanes = LocalFits::Lanes;
using LaneVectors = LocalFits::LaneVectors;
using Terms = system::PlainArray<Lanes, max_terms>;

// The degree, and the power of b, of each of the terms a, b, a^2, ab, b^2, a^3, ...
inline constexpr system::PlainArray<std::size_t, max_terms> degrees = {1, 1, 2, 2, 2, 3, 3, 3, 3};
inline constexpr system::PlainArray<std::size_t, max_terms> powers_of_b = {0, 1, 0, 1, 2,
                                                                           0, 1, 2, 3};

// These are std::max() and std::min(), which compilers do not always inline.
RONDEL_ALWAYS_INLINE inline double larger(double a, double b) { return a < b ? b : a; }
RONDEL_ALWAYS_INLINE inline double smaller(double a, double b) { return b < a ? b : a; }

// Computes `a && b` without a branch.
RONDEL_ALWAYS_INLINE inline bool both(bool a, bool b) {
  return (static_cast<unsigned>(a) & static_cast<unsigned>(b)) != 0;
}

// The data that LocalFits::find() works on, apart from the object, so that the compiler knows that
// nothing aliases it.
struct Fit {
  LaneVectors* points;
  std::size_t size;
  LaneVectors sites;
  Lanes counts;
  Lanes num_terms{};
  Lanes is_found{};
  Lanes is_line{};
  bool with_lines = true;
  Lanes scale{};  // by which the plane's coordinates are multiplied to give lengths
  Lanes farthest{};
  LaneVectors first_axis{};
  LaneVectors second_axis{};
  Lanes largest{};
  Lanes mean_weight{};  // mean weight of the neighbors, weighted by their squared distances
  // The coordinates that make the cloud round: a' = round_a a,  b' = round_b (b - shear a).
  Lanes round_a{};
  Lanes round_b{};
  Lanes shear{};
};

}  // namespace rondel::interpolation::fits
