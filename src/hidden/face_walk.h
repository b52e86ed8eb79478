// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Walks among the solid faces to the one whose closed cone from the center contains a site.
//
//            b           p is beyond the edge (a, b) if it is on the other side than c of the plane
//      p    / \          through the center and the edge. Three rungs tell:
//          /   \         cone      a product with a unit normal kept for the plane; decides all
//         a-----c                  but sites close to the plane
//                        corners   det(p-o, a-p, b-p): relative to the distances of p from the
//                                  corners, so that it decides among faces of any size
//                        exact
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "hidden/frame.h"
#include "predicates/orientation.h"
#include "topology/triangulation_arrays.h"

namespace rondel::hidden {

class FaceWalk {
 public:
  using Vector = predicates::Vector;

  FaceWalk(std::span<const Point> sites, const Point& center, const TriangulationArrays& arrays);

  // Keeps the cones of all faces, 72 bytes each: worthwhile for many walks.
  void keep_cones(unsigned threads);
  void drop_cones() { cones_ = {}; }

  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] Index first_solid() const { return first_solid_; }
  [[nodiscard]] bool is_ghost(Index f) const { return !is_ghost_.empty() && is_ghost_[f]; }

  // Where a walk ended, and the first solid face whose closed cone contains the site. There is none
  // if the walk was cut off, or if the ray passes through `vertex`: then it is the first one there.
  struct Result {
    Index end;
    Index face;
    Index vertex = no_index;
  };

  // From the solid face f, at most so many steps. Ends: location.md. v is p in the frame, `length`
  // its longest coordinate.
  template <bool uses_cones>
  [[nodiscard]] Result walk(Index f, const Point& p, const Vector& v, double length,
                            Index max_steps) const {
    const double bound =
        length > min_length ? cone_bound * length : std::numeric_limits<double>::infinity();
    for (Index steps = 0;; ++steps) {
      std::size_t i = uses_cones ? edge_by_cone(cones_[f], v, bound) : unsure;
      if (i == inside) return {f, f};
      if (i == unsure) {
        i = edge_by_corners(f, p, v);
        if (i == inside) return {f, f};
        if (i == unsure) {
          const auto side = exact_sides(f, p);
          i = index_of(side, Sign::negative);
          if (i == side.size()) return first_of_cones(f, side);
        }
      }
      const Index next = arrays_.neighbors[f][i];
      if (is_ghost(next)) return {f, f};
      if (steps == max_steps) return {f, no_index};
      f = next;
    }
  }

  // A short walk in doubles, which may go wrong.
  [[nodiscard]] Index walk_by_guess(Index f, const Vector& v) const;

 private:
  // The three planes through the center and an edge: positive products on the side of the cone.
  struct Cone {
    std::array<Vector, 3> normal;
  };

  // What the rungs answer: an edge that p is beyond, or one of these.
  static constexpr std::size_t inside = 3;
  static constexpr std::size_t unsure = 4;

  // The unit directions of two corners are off by at most 5u (u for the difference, 2.5u for the
  // length, u for the division), their cross product by 10u and what rounding adds: 2 * 1.155u
  // (filters.md), in length 13u. In the scalar product with p this counts 13u |p|, the error of p
  // u |p|, rounding 3u * 1.155 |p|; |p| is at most sqrt(3) times its longest coordinate: 31u.
  static constexpr double cone_bound = 40 * predicates::unit_roundoff;
  // Below this length the absolute error of a frame's coordinates would count.
  static constexpr double min_length = 1e-90;

  [[nodiscard]] Cone make_cone(Index f) const;

  // The least of three, chosen without branches.
  static std::size_t least_of(const std::array<double, 3>& value) {
    const std::size_t i = value[1] < value[0] ? 1 : 0;
    return value[2] < value[i] ? 2 : i;
  }

  static std::size_t index_of(const std::array<Sign, 3>& signs, Sign sign) {
    return static_cast<std::size_t>(std::ranges::find(signs, sign) - signs.begin());
  }

  static std::size_t edge_by_cone(const Cone& c, const Vector& v, double bound) {
    const std::array<double, 3> value = {dot(c.normal[0], v), dot(c.normal[1], v),
                                         dot(c.normal[2], v)};
    const std::size_t i = least_of(value);
    if (value[i] > bound) return inside;
    return value[i] < -bound ? i : unsure;
  }

  [[nodiscard]] std::size_t edge_by_corners(Index f, const Point& p, const Vector& v) const;
  [[nodiscard]] std::array<Sign, 3> exact_sides(Index f, const Point& p) const;
  [[nodiscard]] Result first_of_cones(Index f, const std::array<Sign, 3>& side) const;

  std::span<const Point> sites_;
  Point center_;
  const TriangulationArrays& arrays_;
  Frame frame_;
  std::vector<bool> is_ghost_;
  Index first_solid_ = 0;
  std::vector<Cone> cones_;
};

}  // namespace rondel::hidden
