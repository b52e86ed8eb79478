// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The hexagons around the corners of the triangles of an icosahedron: the dual of triangle_grid().
//
// N = root * 2^bisections parts of each side of the icosahedron. A corner of triangles is a place of
// a face by its weights: w[0] + w[1] + w[2] = N, w[k] = N at corner k. With i = w[1] and j = w[2] the
// triangles at it are, counterclockwise,
//
//            (i-1,j+1)--(i,j+1)           1: up    (i, j)       4: down  (i - 1, j - 1)
//               / \  2  / \               2: down  (i - 1, j)   5: up    (i, j - 1)
//              / 3 \   / 1 \              3: up    (i - 1, j)   6: down  (i, j - 1)
//         (i-1,j)---(i,j)---(i+1,j)
//              \ 4 /   \ 6 /              where up (i, j) has the corners (i, j), (i + 1, j),
//               \ /  5  \ /               (i, j + 1), and down (i, j) the corners (i + 1, j),
//            (i,j-1)--(i+1,j-1)           (i + 1, j + 1), (i, j + 1)
//
// Triangles beyond the face are in its neighbors.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "exact/vector.h"
#include "grids/grid_formula.h"
#include "grids/icosahedron_faces.h"
#include "meshing/scvt_levels.h"
#include "rondel/delaunay.h"

namespace rondel::grids {
namespace {

using LatticeWeights = std::array<std::int64_t, 3>;
using TriangleCorners = std::array<Point, 3>;

constexpr Index num_corners = 12;
constexpr Index num_edges = 30;

// An edge of the icosahedron, from the corner with the lower index, and the faces to its left and to
// its right.
struct IcosahedronEdge {
  Index from;
  Index to;
  Index left;
  Index right;
};

// Returns the place of a corner in a face.
std::size_t place_in(const IcosahedronFace& face, Index corner) {
  return static_cast<std::size_t>(std::ranges::find(face, corner) - face.begin());
}

// Returns the edges, by their corners in ascending order.
std::vector<IcosahedronEdge> edges_of(const std::vector<IcosahedronFace>& faces) {
  std::vector<IcosahedronEdge> edges;
  edges.reserve(num_edges);
  const auto face_left_of = [&](Index from, Index to) {
    for (Index f = 0; f < faces.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (faces[f][k] == from && faces[f][(k + 1) % 3] == to) return f;
      }
    }
    return no_index;
  };
  for (Index from = 0; from < num_corners; ++from) {
    for (Index to = from + 1; to < num_corners; ++to) {
      const Index left = face_left_of(from, to);
      if (left != no_index) edges.push_back({from, to, left, face_left_of(to, from)});
    }
  }
  return edges;
}

class HexagonGrid : public GridFormula {
 public:
  HexagonGrid(unsigned root, unsigned bisections)
      : triangles_(triangle_grid(root, bisections)),
        root_(root),
        step_(std::int64_t{1} << bisections),
        parts_(static_cast<Index>(root * step_)),
        faces_(icosahedron_faces(mesh::icosahedron())),
        edges_(edges_of(faces_)) {}

  [[nodiscard]] Index num_cells() const override { return 10 * parts_ * parts_ + 2; }

  // The center is the corner that the triangles have in common.
  [[nodiscard]] LonLat center(Index cell) const override {
    const std::vector<Index> around = triangles_around(cell);
    const TriangleCorners first = corners_of(around[0]);
    const TriangleCorners third = corners_of(around[2]);
    std::size_t shared = 0;
    while (std::ranges::find(third, first[shared]) == third.end()) ++shared;
    return lonlats(std::vector<Point>{first[shared]})[0];
  }

  // The corners are the circumcenters of the triangles, of which each is the same bits for three
  // cells. No triangle is obtuse, so cells are those of a Voronoi diagram.
  void append_ring(Index cell, std::vector<Point>& ring) const override {
    for (const Index triangle : triangles_around(cell)) {
      const auto [a, b, c] = corners_of(triangle);
      ring.push_back(normalized(cross(b - a, c - a)));
    }
  }

 private:
  [[nodiscard]] TriangleCorners corners_of(Index triangle) const {
    thread_local std::vector<Point> ring;
    ring.clear();
    triangles_->append_ring(triangle, ring);
    return {ring[0], ring[1], ring[2]};
  }

  // Cells are numbered: the corners of the icosahedron, then those along each of its edges, then
  // those inside of each face, in rows of ascending j.
  [[nodiscard]] std::vector<Index> triangles_around(Index cell) const {
    std::vector<Index> around;
    around.reserve(6);
    if (cell < num_corners) {
      append_around_corner(cell, around);
      return around;
    }
    const Index of_edge = parts_ - 1;
    Index rest = cell - num_corners;
    if (rest < num_edges * of_edge) {
      const IcosahedronEdge& edge = edges_[rest / of_edge];
      const std::int64_t steps = rest % of_edge + 1;
      append_of_face(edge.left, on_edge(edge.left, edge, steps), around);
      append_of_face(edge.right, on_edge(edge.right, edge, steps), around);
      return around;
    }
    rest -= num_edges * of_edge;
    const Index of_face = of_edge * (of_edge - 1) / 2;
    const auto [i, j] = place_inside(rest % of_face);
    append_of_face(rest / of_face, {parts_ - i - j, i, j}, around);
    return around;
  }

  // Returns i and j of a corner inside of a face. Row j >= 1 has N - 1 - j of them, with i from 1 on,
  // so (j - 1) (2 N - 2 - j) / 2 are before it.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> place_inside(std::int64_t number) const {
    const std::int64_t n = parts_;
    const auto before = [&](std::int64_t j) { return (j - 1) * (2 * n - 2 - j) / 2; };
    // The root of before(j) = number; rounding may be off by one.
    const double half = static_cast<double>(n) - 0.5;
    const double root = half - std::sqrt(std::max(half * half - 2.0 * static_cast<double>(n) + 2 -
                                                      2.0 * static_cast<double>(number),
                                                  0.0));
    std::int64_t j = std::clamp<std::int64_t>(static_cast<std::int64_t>(root), 1, n - 2);
    while (j > 1 && before(j) > number) --j;
    while (j < n - 2 && before(j + 1) <= number) ++j;
    return {number - before(j) + 1, j};
  }

  // Returns the weights of the place that is some steps from the first end of an edge.
  [[nodiscard]] LatticeWeights on_edge(Index face, const IcosahedronEdge& edge,
                                       std::int64_t steps) const {
    LatticeWeights weights{};
    weights[place_in(faces_[face], edge.from)] = parts_ - steps;
    weights[place_in(faces_[face], edge.to)] = steps;
    return weights;
  }

  // Appends the triangles at a corner of the icosahedron: one of each face, each beginning where the
  // one before ends.
  void append_around_corner(Index corner, std::vector<Index>& around) const {
    Index face = 0;
    while (place_in(faces_[face], corner) == 3) ++face;
    const Index first = face;
    do {
      const std::size_t at = place_in(faces_[face], corner);
      LatticeWeights weights{};
      weights[at] = parts_;
      append_of_face(face, weights, around);
      const Index last = faces_[face][(at + 2) % 3];
      face = 0;
      while (place_in(faces_[face], corner) == 3 ||
             faces_[face][(place_in(faces_[face], corner) + 1) % 3] != last) {
        ++face;
      }
    } while (face != first);
  }

  // Appends those triangles at a place that are in a face, counterclockwise. At its border they are
  // consecutive, and the first one comes after one that is missing.
  void append_of_face(Index face, const LatticeWeights& place, std::vector<Index>& around) const {
    const std::int64_t i = place[1];
    const std::int64_t j = place[2];
    struct LatticeTriangle {
      std::int64_t i;
      std::int64_t j;
      bool is_up;
    };
    const std::array<LatticeTriangle, 6> all = {{{i, j, true},
                                                 {i - 1, j, false},
                                                 {i - 1, j, true},
                                                 {i - 1, j - 1, false},
                                                 {i, j - 1, true},
                                                 {i, j - 1, false}}};
    const auto is_there = [&](const LatticeTriangle& triangle) {
      return triangle.i >= 0 && triangle.j >= 0 &&
             triangle.i + triangle.j + (triangle.is_up ? 1 : 2) <= parts_;
    };
    std::size_t first = 0;
    while (first < 6 && is_there(all[first])) ++first;
    for (std::size_t k = 0; k < 6; ++k) {
      const LatticeTriangle& triangle = all[(first + k) % 6];
      if (is_there(triangle)) {
        around.push_back(number_of(face, triangle.i, triangle.j, triangle.is_up));
      }
    }
  }

  // Returns the number of a triangle in triangle_grid(). Its center has weights in a triangle of each
  // level, whose sum is 3 times the length s of a side there, in steps of the lattice.
  [[nodiscard]] Index number_of(Index face, std::int64_t i, std::int64_t j, bool is_up) const {
    const std::int64_t sum_i = 3 * i + (is_up ? 1 : 2);
    const std::int64_t sum_j = 3 * j + (is_up ? 1 : 2);
    std::int64_t s = step_;
    const std::int64_t column = sum_i / (3 * s);
    const std::int64_t row = sum_j / (3 * s);
    const std::int64_t along = sum_i - 3 * s * column;
    const std::int64_t up = sum_j - 3 * s * row;
    const bool is_root_up = along + up < 3 * s;
    LatticeWeights w = is_root_up ? LatticeWeights{3 * s - along - up, along, up}
                                  : LatticeWeights{3 * s - up, along + up - 3 * s, 3 * s - along};
    // Row r of a face has 2 (root - r) - 1 triangles.
    const std::int64_t root = root_;
    std::int64_t number = face * root * root + row * (2 * root - row) + 2 * column;
    if (!is_root_up) ++number;
    for (; s > 1; s /= 2) {
      const std::int64_t half = 3 * s / 2;
      const std::array<std::int64_t, 3> beyond = {w[0] - half, w[1] - half, w[2] - half};
      std::int64_t part = 0;
      if (beyond[0] > 0) {
        part = 1;
        w = {beyond[0], w[1], w[2]};
      } else if (beyond[1] > 0) {
        part = 2;
        w = {beyond[1], w[2], w[0]};
      } else if (beyond[2] > 0) {
        part = 3;
        w = {beyond[2], w[0], w[1]};
      } else {
        w = {-beyond[0], -beyond[1], -beyond[2]};
      }
      number = 4 * number + part;
    }
    return static_cast<Index>(number);
  }

  std::unique_ptr<GridFormula> triangles_;
  unsigned root_;
  std::int64_t step_;  // of the lattice in a side of a triangle of the root
  Index parts_;
  std::vector<IcosahedronFace> faces_;
  std::vector<IcosahedronEdge> edges_;
};

}  // namespace

std::unique_ptr<GridFormula> hexagon_grid(unsigned root, unsigned bisections) {
  return std::make_unique<HexagonGrid>(root, bisections);
}

}  // namespace rondel::grids
