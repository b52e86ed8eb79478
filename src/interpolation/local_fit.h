// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Estimates the gradient at a site x from the values around it. It is the gradient at x of a
// polynomial in the stereographic plane of x (scaled to true length at x) that has the value of x
// there and fits the values of the neighbors in the sense of weighted least squares, with the
// weights
//
//     w = ((1 - r) / max(r, 1/4))^4,   r = the distance over 1.2 times that of the farthest neighbor.
//
// The fit is cubic where the neighbors determine a cubic polynomial well, and otherwise quadratic,
// linear or of one variable (settled_fit.h). GRADL in Renka's SSRFPACK (ACM TOMS 23, 1997) has a
// quadratic fit and the square of (1 - r) / r; the weights here were chosen by measurements with
// smooth functions (docs/theory/cubic.md). The lower bound 1/4 limits the effect of noise, above
// all that of pairs of sites that are much nearer than others.
//
// The plane's coordinates are changed such that the weighted second moments are those of a round
// cloud. This changes no fit, but makes the fits of thin clouds accurate. The columns of the normal
// equations, whose entries are 25 moments, are ordered by degree, so that one factorization L D L^T
// serves all three degrees. A pivot below min_pivot times its diagonal entry ends the
// factorization at the degree before. Rounding errors of weights are therefore below 1e-9 of the
// largest weight, mostly 1e-13, and polynomials are reproduced to that accuracy.
//
// Several sites are computed at once, each in a lane of vectors. No lane depends on another: a site
// has the same result in every lane and beside any other sites.
//
// in    for each lane a site and the steps to its neighbors
// out   for each lane the weight, a tangent vector, of each neighbor's value
// index lanes; k: neighbors of the site of a lane, in the order in which they were set
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "exact/vector.h"
#include "rondel/types.h"
#include "system/wide_vectors.h"

namespace rondel::interpolation {

class LocalFits {
 public:
  static constexpr std::size_t lanes = 8;
  static constexpr std::size_t max_terms = 9;
  static constexpr std::array<std::size_t, 3> terms_of_degree = {2, 5, 9};
  static constexpr double min_pivot = 0x1p-16;

  using Vec = exact::Vector3<double>;
  using Lanes = system::PlainArray<double, lanes>;
  struct alignas(64) LaneVectors {
    Lanes x;
    Lanes y;
    Lanes z;
  };

  // Forgets all sites and makes room for `max_neighbors` neighbors of each.
  void start(std::size_t max_neighbors);
  // Sets neighbor k of the site of a lane, at the site + step. Precondition: |step| <= sqrt(3).
  void set_neighbor(std::size_t lane, std::size_t k, const Vec& step) {
    LaneVectors& point = points_[k];
    point.x[lane] = step.x;
    point.y[lane] = step.y;
    point.z[lane] = step.z;
  }
  // Sets the unit vector of the site and the number of its neighbors, which have been set before.
  void set_site(std::size_t lane, const Vec& x, std::size_t num_neighbors);
  // Computes the fits of all lanes. Where the neighbors determine the slope only along a line, the
  // gradient is along that line if `with_lines`, and otherwise there is none.
  void find(bool with_lines = true);

  // False if the site has no neighbors, or some that are so near that weights would exceed 2^500.
  [[nodiscard]] bool has_gradient(std::size_t lane) const { return is_found_[lane] != 0; }
  // The gradient is the sum of weight(lane, k) (f_k - f(x)) over the neighbors k. The weights are
  // tangent at x.
  [[nodiscard]] Vec weight(std::size_t lane, std::size_t k) const {
    return {points_[k].x[lane], points_[k].y[lane], points_[k].z[lane]};
  }
  [[nodiscard]] std::size_t num_neighbors(std::size_t lane) const {
    return static_cast<std::size_t>(counts_[lane]);
  }
  // True if the gradient is along a line.
  [[nodiscard]] bool is_line(std::size_t lane) const { return is_line_[lane] != 0; }
  // Returns the number of terms of the polynomial, which has two variables, or one if is_line().
  [[nodiscard]] std::size_t num_terms(std::size_t lane) const {
    return static_cast<std::size_t>(num_terms_[lane]);
  }

  // Returns how many neighbors a lane has room for.
  [[nodiscard]] std::size_t num_places() const { return points_.size(); }
  // Returns the gradients of a field in all lanes: values[k] has the value of neighbor k of each
  // lane, and `here` the values at the sites. The sum is that of weight() above. Lanes without
  // has_gradient() have no meaning.
  [[nodiscard]] LaneVectors gradients(const std::vector<Lanes>& values, const Lanes& here) const;

 private:
  // By neighbor: first the steps, then a, b and weights in the plane, at last the weights of
  // gradients. Lanes with fewer neighbors are filled with steps of length 0.
  std::vector<LaneVectors> points_;
  LaneVectors sites_{};
  Lanes counts_{};  // counts and 0 or 1 as doubles, so that they fit the lanes
  Lanes num_terms_{};
  Lanes is_found_{};
  Lanes is_line_{};
};

}  // namespace rondel::interpolation
