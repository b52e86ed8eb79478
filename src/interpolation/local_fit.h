// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The gradient at a site x from the values around it: that of the polynomial in the stereographic plane
// of x (scaled so that it is true to length at x) which has the value of x there and fits those of the
// neighbors best, in the sense of weighted least squares with the weights
//
//     w = ((1 - r) / max(r, 1/4))^4,   r = the distance over 1.2 times that of the farthest neighbor.
//
// The fit is cubic, and quadratic, linear or of one variable where the neighbors do not determine it well
// (settled_fit.h). (GRADL in
// Renka's SSRFPACK, ACM TOMS 23, 1997, has a quadratic fit and the square of (1 - r) / r; what is best
// for smooth functions was measured: docs/theory/cubic.md. The bound keeps noise small, above all that
// of pairs of sites much nearer than others.)
//
// The plane's coordinates are first made such that the weighted second moments are those of a round
// cloud, which changes no fit but lets thin clouds pass. Of the normal equations, whose entries are 25
// moments, the columns stand in the order of their degree; so one factorization L D L^T serves all three
// fits. A pivot below least_pivot of its diagonal entry ends it at the degree before; so rounding errors
// of weights are below 1e-9 of the largest, mostly 1e-13, and polynomials come back as exactly.
//
// Several sites are worked on at once, each in a lane of vectors. Lanes know nothing of each other: the
// result is the same in every lane and beside any others.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "exact/vector.h"
#include "rondel/types.h"
#include "system/plain_array.h"

namespace rondel::interpolation {

class LocalFits {
 public:
  static constexpr std::size_t lanes = 8;
  static constexpr std::size_t max_terms = 9;
  static constexpr std::array<std::size_t, 3> terms_of_degree = {2, 5, 9};
  static constexpr double least_pivot = 0x1p-16;

  using Vec = exact::Vector3<double>;
  using Lanes = system::PlainArray<double, lanes>;
  struct alignas(64) LaneVectors {
    Lanes x;
    Lanes y;
    Lanes z;
  };

  // Forgets all sites; room for so many neighbors of each.
  void start(std::size_t most_neighbors);
  // A neighbor of the site of a lane at the site + step. Precondition: that is no longer than sqrt(3).
  void set_neighbor(std::size_t lane, std::size_t k, const Vec& step) {
    LaneVectors& point = points_[k];
    point.x[lane] = step.x;
    point.y[lane] = step.y;
    point.z[lane] = step.z;
  }
  // The site, and how many neighbors have been set.
  void set_site(std::size_t lane, const Vec& x, std::size_t num_neighbors);
  // Afterwards lanes can be asked. Where the neighbors determine the slope along a line alone, the gradient is along it,
  // or, without lines, there is none.
  void find(bool with_lines = true);

  // There is no gradient if there are no neighbors, or some are so near that weights are above 2^500.
  [[nodiscard]] bool has_gradient(std::size_t lane) const { return is_found_[lane] != 0; }
  // The gradient is the sum of weight(lane, k) (f_k - f(x)), k over the neighbors in their order. The
  // weights are tangent at x.
  [[nodiscard]] Vec weight(std::size_t lane, std::size_t k) const {
    return {points_[k].x[lane], points_[k].y[lane], points_[k].z[lane]};
  }
  [[nodiscard]] std::size_t num_neighbors(std::size_t lane) const {
    return static_cast<std::size_t>(counts_[lane]);
  }
  [[nodiscard]] bool is_line(std::size_t lane) const { return is_line_[lane] != 0; }
  // The number of terms of the polynomial of two variables or, on a line, of one.
  [[nodiscard]] std::size_t num_terms(std::size_t lane) const {
    return static_cast<std::size_t>(num_terms_[lane]);
  }

  // Room for neighbors in each lane.
  [[nodiscard]] std::size_t num_places() const { return points_.size(); }
  // The gradients of a field with these values at the neighbors, value k of a lane in values[k], and
  // here at the sites: what the sums above give. Others than of has_gradient() mean nothing.
  [[nodiscard]] LaneVectors gradients(const std::vector<Lanes>& values, const Lanes& here) const;

 private:
  // Of the neighbors, in turns: steps; a, b and weights in the plane; weights of gradients. Lanes that
  // have fewer are filled up with steps of no length.
  std::vector<LaneVectors> points_;
  LaneVectors sites_{};
  Lanes counts_{};  // numbers and truth as doubles, so that they fit the lanes
  Lanes num_terms_{};
  Lanes is_found_{};
  Lanes is_line_{};
};

}  // namespace rondel::interpolation
