// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Lowers the degree of a local fit until its neighbors determine the polynomial (local_fit.h): the
// settled fit may have a lower degree than the one that was tried, or one variable.
//
// in    the moments of a fit and the polynomials that solve it
// out   the same with fewer terms, or of one variable
//
// The gradient of a fit of degree d is exact for polynomials of degree d. Monomials of a degree D >
// d have the gradient 0 at the site; the gradient that the fit gives them is its *excess*. With the
// neighbors at p_k, the weights q_k of their values in the gradient, R the distance of the
// farthest, and the first axis towards it,
//
//     E_D^2 = sum over the monomials m of degree D of |R sum of q_k m(p_k / R)|^2,     E the largest for D = d + 1 ... 4.
//
// If the terms of degree D of a function change it by up to M in the neighborhood, the error of the
// gradient is up to E_D M / R. A gradient that is set to 0 has an error of its own length. E has no
// unit and does not depend on the scale. Around sites that cover a part of the sphere, at random or
// as a grid, it is less than 1 (docs/theory/cubic.md). It grows as 1/t where the neighbors are
// nearly on a line, t being the ratio of breadth to length of the cloud, and likewise where they
// are nearly on a conic.
//
// Waves that are shorter than the neighborhood, and noise, are not polynomials of low degree. The
// response of a fit to them is bounded by its *gain* N = R sqrt(sum of |q_k|^2), which is R times
// the standard deviation of the gradient for independent values of standard deviation 1. Values
// with the variances 1 / w_k give the simpler sum N^2 = R^2 W sum of |q_k|^2 / w_k, which follows
// from the solution of the normal equations alone; W is the mean of the weights, weighted by the
// squared distances. Around random sites the median of N is 7 and its maximum 50. It is thousands
// beside the poles of a grid that has no sites there, and beside a track with a site far off it.
//
// So the degree is lowered until E is at most max_excess and N at most max_gain. If they are
// larger for the linear fit too, the neighbors do not determine the slope across the line of their
// greatest extent: it is set to 0, and the slope along that line is that of a polynomial of one
// variable, of degree up to 3.
#pragma once

#include <array>
#include <cstddef>

namespace rondel::interpolation {

inline constexpr double max_excess = 1;
inline constexpr double max_gain = 100;
// The slope along a line may take up to this part of a slope across it.
inline constexpr double max_slope_across = 0.5;

// Sums over the neighbors of weight a^(s-q) b^q, s = 2 ... 7, in the coordinates that make their
// cloud round.
inline constexpr std::size_t num_fit_moments = 33;
using FitMoments = std::array<double, num_fit_moments>;
using FitTerms = std::array<double, 9>;  // a, b, a^2, ab, b^2, a^3 ...

struct SettledFit {
  FitMoments moments;
  // The coordinates of the plane are a / round_a and b / round_b + shear a / round_a.
  double round_a;
  double round_b;
  double shear;
  double radius;       // distance of the farthest neighbor in the plane
  double mean_weight;  // mean weight of the neighbors, weighted by their squared distances
  std::size_t num_neighbors;
  bool is_plane;  // false if the cloud is a line
  // The polynomials whose values times the weights are the weights of the slopes along a and b. On
  // input, for a plane, they are those of the fit of the highest degree.
  std::size_t num_terms;
  FitTerms by_a;
  FitTerms by_b;
};

// The sums that give the excess of degree 4 of a cubic fit: over the neighbors, weight by_a m for
// each monomial m, and weight by_b m.
struct CubicExcess {
  std::array<double, 5> of_a;
  std::array<double, 5> of_b;
};
// Returns E_4.
double excess_of_cubic(const SettledFit& fit, const CubicExcess& sums);
// Returns N, for a fit in the plane.
double gain(const SettledFit& fit);

// Lowers the degree, or changes to a fit along a line: then is_plane becomes false, and num_terms
// is the number of terms in one variable. Precondition: there is a neighbor, and not all are in the
// place of the site.
void settle(SettledFit& fit);

}  // namespace rondel::interpolation
