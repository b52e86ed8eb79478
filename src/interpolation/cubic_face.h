// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// One face of the spherical Clough-Tocher element, as weights of the data at its corners and at the
// corners beyond its edges.
//
// Notation. x_0, x_1, x_2 are the corners; k is one of them and the edge opposite to it, from x_i to x_j
// (i = k+1, j = k+2, modulo 3); y_k is the vertex beyond edge k. Homogeneous cubic polynomials are
// written by their blossom p[., ., .], which is symmetric and linear in each of its three vectors; with
// the value f and the tangent gradient g at a vertex x,
//
//     p[x, x, x] = f    and    p[x, x, z] = f x.z + g.z / 3.
//
// The face is split at the direction v of its center, v = (x_0 + x_1 + x_2) / 3. Of each edge, the one
// number that no corner gives is
//
//     e_k = p[x_i, x_j, x_k] = a p[x_i, x_i, x_j] + b p[x_i, x_j, x_j] + X,    x_k = a x_i + b x_j + H,
//
// with H normal to the plane of the edge and X = p[x_i, x_j, H]. It decides the derivative across the
// edge and is found such that both faces of the edge find the same:
//
//     X_2 = cos(x_i, x_j) (g_i + g_j).H / 6       makes that derivative linear,
//     X_4 fits p[x_k, x_k, .] and p[y_k, y_k, .] at x_i and x_j, in least squares: exact on cubics
//
// (Mann, CAGD 16, 1999, in the plane; there after Foley and Opitz, 1992). X_4 counts by a factor from
// 0 to 1 that is 0 without a y_k, 1 if both faces of the edge are higher than an eighth of it. Where a
// or b is beyond 1024, e_k is the mean of p[x_i, x_i, x_k] and p[x_j, x_j, x_k], and the gradient is not
// continuous at that edge, which is that much shorter than its faces.
//
// The weights follow by going through the evaluation backwards: from what the value takes of each
// coefficient to what that takes of the data.
#pragma once

#include <array>

#include "exact/vector.h"

namespace rondel::interpolation {

class CubicFace {
 public:
  using Vec = exact::Vector3<double>;
  struct Vertex {
    Vec place{};  // rounded
    Vec step{};   // from one point near the face, right in every digit
  };
  std::array<Vertex, 3> corners{};
  std::array<Vertex, 3> opposites{};
  std::array<bool, 3> has_opposite{};

  // The value at sum of l_i x_i is the sum of weights times values and of slopes times gradients,
  // corners first, then opposites. Slopes are tangent.
  struct FaceWeights {
    std::array<double, 6> weights{};
    std::array<Vec, 6> slopes{};
  };

  // False where the face is too large or too small; then nothing is weighed.
  bool weigh(const std::array<double, 3>& l, FaceWeights& result);

  // |sum of l_i x_i|^2, after weigh().
  [[nodiscard]] double squared_norm(const std::array<double, 3>& l) const {
    return 1 - (l[1] * l[2] * squares_[0] + l[2] * l[0] * squares_[1] + l[0] * l[1] * squares_[2]);
  }

 private:
  struct FaceEdge;
  void weigh_points(const std::array<double, 3>& l);
  void weigh_edge(unsigned k, FaceWeights& result);
  double weigh_across(const FaceEdge& edge, unsigned k, FaceWeights& result);
  void collect(FaceWeights& result) const;

  // What the value takes of p[x_i, x_i, x_j] at [i][j], of f_i at [i][i], of e_k.
  std::array<std::array<double, 3>, 3> of_pairs_{};
  std::array<double, 3> of_edges_{};
  std::array<double, 3> squares_{};  // of the length of edge k
};

}  // namespace rondel::interpolation
