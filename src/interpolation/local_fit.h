// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The gradient at a site x from the values around it: that of the polynomial in the stereographic plane
// of x (scaled so that it is true to length at x) which has the value of x there and fits those of the
// neighbors best, in the sense of weighted least squares with the weights
//
//     w = ((1 - r) / max(r, 1/4))^4,   r = the distance over 1.2 times that of the farthest neighbor.
//
// The fit is cubic, and quadratic or linear where the neighbors do not determine it well. (GRADL in
// Renka's SSRFPACK, ACM TOMS 23, 1997, has a quadratic fit and the square of (1 - r) / r; what is best
// for smooth functions was measured: docs/theory/cubic.md. The bound keeps noise small, above all that
// of pairs of sites much nearer than others.)
//
// The plane's coordinates are first made such that the weighted second moments are those of a round
// cloud, which changes no fit but lets thin clouds pass. Of the normal equations, whose entries are 25
// moments, the columns stand in the order of their degree; so one factorization L D L^T serves all three
// fits. A pivot below least_pivot of its diagonal entry ends it at the degree before; so rounding errors
// of weights are below 1e-9 of the largest, mostly 1e-13, and polynomials come back as exactly.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "exact/vector.h"
#include "rondel/types.h"

namespace rondel::interpolation {

class LocalFit {
 public:
  static constexpr std::size_t max_terms = 9;
  static constexpr std::array<std::size_t, 3> terms_of_degree = {2, 5, 9};
  static constexpr double least_pivot = 0x1p-16;

  using Vec = exact::Vector3<double>;

  // The gradient is the sum of weights[k] (f_k - f(x)), k over the neighbors at x + steps[k], in their
  // order. The weights are tangent at x. None if the neighbors are all in line with x, or there are
  // none. Precondition: no step is longer than sqrt(3).
  bool find(const Vec& x, std::span<const Vec> steps, std::vector<Vec>& weights);

  // How many terms the polynomial of the last fit had.
  [[nodiscard]] std::size_t num_terms() const { return num_terms_; }

 private:
  // Neighbors come in fours, so that the loops over them become vector code; sums are of each fourth
  // one, and these are added at last. Those that fill up have no weight.
  static constexpr std::size_t lanes = 4;
  using Four = std::array<double, lanes>;
  struct ChartPoints {
    Four a;
    Four b;
    Four weight;
  };
  using Coefficients = std::array<double, max_terms>;

  bool set_chart(const Vec& x, std::span<const Vec> steps);
  void set_weights(double largest_square);
  bool make_round();
  void add_moments();
  [[nodiscard]] double entry(std::size_t i, std::size_t j) const;
  void factor(std::size_t most_terms);
  [[nodiscard]] Coefficients solved_for(std::size_t unit) const;

  std::vector<ChartPoints> points_;
  Vec first_axis_{};
  Vec second_axis_{};
  double scale_ = 0;  // the unit of the plane's coordinates

  // a' = to_round_[0] a,  b' = to_round_[1] (b - shear_ a)
  std::array<double, 2> to_round_{};
  double shear_ = 0;

  // moments_[s - 2][q]: the weighted sum of a'^(s-q) b'^q
  std::array<std::array<double, 7>, 5> moments_{};
  std::array<Coefficients, max_terms> lower_{};
  Coefficients pivots_{};
  std::size_t num_terms_ = 0;
};

}  // namespace rondel::interpolation
