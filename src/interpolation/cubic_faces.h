// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Faces of the spherical Clough-Tocher element, as weights of the data at their corners and at the
// vertices beyond their edges. Several faces are computed at once, each in a lane of vectors; no
// lane depends on another.
//
// in    for each lane the corners of a face, the vertices beyond its edges, and a point in the face
// out   for each lane six weights of values and six of gradients
// index lanes; k = 0 ... 2 corners, k = 3 ... 5 the vertices opposite to corners 0 ... 2
//
// Notation. x_0, x_1, x_2 are the corners; k is one of them and the edge opposite to it, from x_i
// to x_j (i = k+1, j = k+2, modulo 3); y_k is the vertex beyond edge k. Homogeneous cubic
// polynomials are written by their blossom p[., ., .], which is symmetric and linear in each of its
// three vectors; with the value f and the tangent gradient g at a vertex x,
//
//     p[x, x, x] = f    and    p[x, x, z] = f x.z + g.z / 3.
//
// The face is split at the direction v of its center, v = (x_0 + x_1 + x_2) / 3. For each edge, one
// number is not determined by the data at the corners:
//
//     e_k = p[x_i, x_j, x_k] = a p[x_i, x_i, x_j] + b p[x_i, x_j, x_j] + X,    x_k = a x_i + b x_j + H,
//
// with H normal to the plane of the edge and X = p[x_i, x_j, H]. It determines the derivative
// across the edge and is chosen such that both faces of the edge have the same:
//
//     X_2 = cos(x_i, x_j) (g_i + g_j).H / 6       makes that derivative linear,
//     X_4 fits p[x_k, x_k, .] and p[y_k, y_k, .] at x_i and x_j, in least squares: exact on cubics
//
// (Mann, CAGD 16, 1999, in the plane; there after Foley and Opitz, 1992). X_4 is multiplied by a
// factor between 0 and 1, which is 0 if there is no y_k and 1 if both faces of the edge are higher
// than an eighth of the edge. Where a or b is beyond 1024, e_k is the mean of p[x_i, x_i, x_k] and
// p[x_j, x_j, x_k], and the gradient is not continuous at that edge, which is so much shorter than
// its faces.
//
// The weights follow by running the evaluation backwards: from the derivative of the value with
// respect to each coefficient to its derivative with respect to the data.
#pragma once

#include <array>
#include <cstddef>

#include "exact/vector.h"
#include "system/wide_vectors.h"

namespace rondel::interpolation {

class CubicFaces {
 public:
  static constexpr std::size_t lanes = 8;

  using Vec = exact::Vector3<double>;
  using Lanes = system::PlainArray<double, lanes>;
  struct alignas(64) LaneVectors {
    Lanes x;
    Lanes y;
    Lanes z;
  };
  template <class T, std::size_t N>
  using Array = system::PlainArray<T, N>;
  struct Vertex {
    LaneVectors place;  // the unit vector, rounded
    LaneVectors step;   // the difference to one point near the face, correct to all digits
  };

  void set_corner(std::size_t lane, std::size_t k, const Vec& place, const Vec& step) {
    set(lane, place, step, state_.corners[k]);
  }
  // Sets the vertex beyond edge k; call it after set_corner(). Without it the edge has no face
  // beyond.
  void set_opposite(std::size_t lane, std::size_t k, const Vec& place, const Vec& step) {
    set(lane, place, step, state_.opposites[k]);
    state_.has_opposite[k][lane] = 1;
  }
  void clear_opposite(std::size_t lane, std::size_t k) { state_.has_opposite[k][lane] = 0; }
  [[nodiscard]] bool has_opposite(std::size_t lane, std::size_t k) const {
    return state_.has_opposite[k][lane] != 0;
  }
  // Sets the point to evaluate at, the sum of l_i x_i.
  void set_point(std::size_t lane, const std::array<double, 3>& l) {
    for (std::size_t k = 0; k < l.size(); ++k) state_.l[k][lane] = l[k];
  }

  // Computes the weights of all lanes; weight(), slope() and is_weighed() are valid afterwards.
  void weigh();

  // False if the face is too large or too small for the element; its weights have no meaning then.
  [[nodiscard]] bool is_weighed(std::size_t lane) const { return state_.is_weighed[lane] != 0; }
  // The value at the point is the sum of weight(k) times value k plus the sum of slope(k) .
  // gradient k, over the corners and then the opposite vertices. The slopes are tangent vectors.
  [[nodiscard]] double weight(std::size_t lane, std::size_t k) const {
    return state_.weights[k][lane];
  }
  [[nodiscard]] Vec slope(std::size_t lane, std::size_t k) const {
    const LaneVectors& slopes = state_.slopes[k];
    return {slopes.x[lane], slopes.y[lane], slopes.z[lane]};
  }
  // Returns |sum of l_i x_i|^2.
  [[nodiscard]] double squared_norm(std::size_t lane) const {
    const auto& l = state_.l;
    const auto& squares = state_.squares;
    return 1 - (l[1][lane] * l[2][lane] * squares[0][lane] +
                l[2][lane] * l[0][lane] * squares[1][lane] +
                l[0][lane] * l[1][lane] * squares[2][lane]);
  }

  // The data of all lanes, apart from the object, so that the compiler knows that nothing aliases
  // it.
  struct FaceLanes {
    Array<Vertex, 3> corners;
    Array<Vertex, 3> opposites;
    Array<Lanes, 3> has_opposite;  // 0 or 1 as doubles, so that they fit the lanes
    Array<Lanes, 3> l;

    Array<Lanes, 3> squares;  // of the length of edge k
    // The derivative of the value: by p[x_i, x_i, x_j] at [i][j], by f_i at [i][i], by e_k in
    // of_edges.
    Array<Array<Lanes, 3>, 3> of_pairs;
    Array<Lanes, 3> of_edges;

    Lanes is_weighed;
    Array<Lanes, 6> weights;
    Array<LaneVectors, 6> slopes;
  };

 private:
  static void set(std::size_t lane, const Vec& place, const Vec& step, Vertex& vertex) {
    vertex.place.x[lane] = place.x;
    vertex.place.y[lane] = place.y;
    vertex.place.z[lane] = place.z;
    vertex.step.x[lane] = step.x;
    vertex.step.y[lane] = step.y;
    vertex.step.z[lane] = step.z;
  }

  FaceLanes state_{};
};

}  // namespace rondel::interpolation
