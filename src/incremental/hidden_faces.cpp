// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "incremental/hidden_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "incremental/direction_grid.h"
#include "incremental/frame.h"
#include "predicates/orientation.h"

namespace rondel::incremental {
namespace {

using predicates::Vector;

// The three planes through the center and an edge: positive products on the side of the cone.
struct Cone {
  std::array<Vector, 3> normal;
};

// The unit directions of two corners are off by at most 5u (u for the difference, 2.5u for the
// length, u for the division), their cross product by 10u and what rounding adds: 2 * 1.155u
// (filters.md), in length 13u. In the scalar product with p this counts 13u |p|, the error of p
// u |p|, rounding 3u * 1.155 |p|; |p| is at most sqrt(3) times its longest coordinate: 31u.
constexpr double cone_bound = 40 * predicates::unit_roundoff;
// Below this length the absolute error of a frame's coordinates would count.
constexpr double least_length = 1e-90;

// A vector that is too short becomes zero: products with it decide nothing.
Vector unit(const Vector& v) {
  const double squared = dot(v, v);
  if (!(squared > least_length * least_length)) return {};
  const double length = std::sqrt(squared);
  return {v.x / length, v.y / length, v.z / length};
}

class FaceFinder {
 public:
  FaceFinder(std::span<const Point> sites, const Point& center, const TriangulationArrays& arrays)
      : sites_(sites),
        center_(center),
        arrays_(arrays),
        frame_(sites, center),
        grid_(cells_for(std::min(arrays.hidden.size(), arrays.faces.size()))),
        is_ghost_(arrays.ghost_faces.empty() ? 0 : arrays.faces.size(), false) {
    for (const Index f : arrays.ghost_faces) is_ghost_[f] = true;
    while (is_ghost(first_solid_)) ++first_solid_;
    if (arrays.hidden.size() > arrays.faces.size() / 4) {
      cones_.reserve(arrays.faces.size());
      for (Index f = 0; f < arrays.faces.size(); ++f) cones_.push_back(make_cone(f));
    }
    fill_grid();
  }

  [[nodiscard]] Index face_above(const Point& p) {
    const Vector v = frame_.to(p);
    const Direction d = grid_.direction(v);
    if (!(d.length > 0)) return walk(first_solid_, p, v, 0).result;
    Index& start = starts_[grid_.cell(d)];
    const Walk found = walk(start, p, v, d.length);
    // Sites whose rays pass a vertex of high degree often come in the same direction.
    constexpr unsigned many = 8;
    if (found.steps > many) start = found.end;
    return found.result;
  }

 private:
  struct Walk {
    Index end;
    Index result;
    unsigned steps;
  };

  // Ends: location.md. `length` is the longest coordinate of v, which is p in the frame.
  [[nodiscard]] Walk walk(Index f, const Point& p, const Vector& v, double length) {
    const double bound =
        length > least_length ? cone_bound * length : std::numeric_limits<double>::infinity();
    for (unsigned steps = 0;; ++steps) {
      const Cone& c = cone(f);
      const std::array<double, 3> value = {dot(c.normal[0], v), dot(c.normal[1], v),
                                           dot(c.normal[2], v)};
      // The edge that p is beyond most, chosen without branches.
      std::size_t i = value[1] < value[0] ? 1 : 0;
      i = value[2] < value[i] ? 2 : i;
      if (value[i] > bound) return {f, f, steps};
      if (!(value[i] < -bound)) {
        const auto side = exact_sides(f, p);
        i = static_cast<std::size_t>(std::ranges::find(side, Sign::negative) - side.begin());
        if (i == 3) return {f, first_of_cones(f, side), steps};
      }
      const Index next = arrays_.neighbors[f][i];
      if (is_ghost(next)) return {f, f, steps};
      f = next;
    }
  }

  // Some 2.4 cells for each face or hidden site, whatever there is less of.
  static unsigned cells_for(std::size_t size) {
    constexpr double cells_for_each = 0.4;
    const double cells = std::sqrt(cells_for_each * static_cast<double>(size));
    return std::clamp(static_cast<unsigned>(cells), 1U, 256U);
  }

  [[nodiscard]] bool is_ghost(Index f) const { return !is_ghost_.empty() && is_ghost_[f]; }

  [[nodiscard]] Cone make_cone(Index f) const {
    const auto& [a, b, c] = arrays_.faces[f];
    const Vector u = unit(frame_.to(sites_[a]));
    const Vector v = unit(frame_.to(sites_[b]));
    const Vector w = unit(frame_.to(sites_[c]));
    return {{cross(v, w), cross(w, u), cross(u, v)}};
  }

  [[nodiscard]] const Cone& cone(Index f) {
    if (!cones_.empty()) return cones_[f];
    cone_ = make_cone(f);
    return cone_;
  }

  // On which side of the edges' planes p lies: positive inside.
  [[nodiscard]] std::array<Sign, 3> exact_sides(Index f, const Point& p) const {
    const auto& [a, b, c] = arrays_.faces[f];
    const auto side = [&](Index from, Index to) {
      return predicates::orientation_ladder(sites_[from], sites_[to], p, center_).sign;
    };
    return {side(b, c), side(c, a), side(a, b)};
  }

  // p lies in the closed cone of f: on no edge, on one, on two (then its ray meets their
  // common corner), or on all three (then it is the center).
  [[nodiscard]] Index first_of_cones(Index f, const std::array<Sign, 3>& side) {
    const auto zeros = std::ranges::count(side, Sign::zero);
    if (zeros == 0) return f;
    if (zeros == 3) return first_solid_;
    if (zeros == 1) {
      const auto edge =
          static_cast<std::size_t>(std::ranges::find(side, Sign::zero) - side.begin());
      const Index neighbor = arrays_.neighbors[f][edge];
      return is_ghost(neighbor) ? f : std::min(f, neighbor);
    }
    const auto corner =
        static_cast<std::size_t>(std::ranges::find(side, Sign::positive) - side.begin());
    return first_at(arrays_.faces[f][corner]);
  }

  // The first solid face with the vertex.
  [[nodiscard]] Index first_at(Index vertex) {
    if (first_at_.empty()) {
      first_at_.assign(sites_.size(), no_index);
      for (Index f = 0; f < arrays_.faces.size(); ++f) {
        if (is_ghost(f)) continue;
        for (const Index v : arrays_.faces[f]) first_at_[v] = std::min(first_at_[v], f);
      }
    }
    return first_at_[vertex];
  }

  // A face at a vertex in each cell, or one of the cell before, and from there by a walk to the
  // middle. Walks in doubles may go wrong, and they are short, so that needles do not cost much.
  void fill_grid() {
    starts_.assign(grid_.num_cells(), no_index);
    for (Index f = 0; f < arrays_.faces.size(); ++f) {
      if (is_ghost(f)) continue;
      const Direction d = grid_.direction(frame_.to(sites_[arrays_.faces[f][0]]));
      if (d.length > 0) starts_[grid_.cell(d)] = f;
    }
    Index last = first_solid_;
    Index* start = starts_.data();
    for (unsigned side = 0; side < 6; ++side) {
      for (unsigned i = 0; i < grid_.cells(); ++i) {
        for (unsigned j = 0; j < grid_.cells(); ++j, ++start) {
          last = walk_by_guess(*start == no_index ? last : *start,
                               grid_.point(side, i + 0.5, j + 0.5));
          *start = last;
        }
      }
    }
  }

  [[nodiscard]] Index walk_by_guess(Index f, const Vector& v) {
    constexpr int most_steps = 32;
    for (int step = 0; step < most_steps; ++step) {
      const Cone& c = cone(f);
      std::size_t i = 0;
      while (i < 3 && !(dot(c.normal[i], v) < 0)) ++i;
      if (i == 3 || is_ghost(arrays_.neighbors[f][i])) return f;
      f = arrays_.neighbors[f][i];
    }
    return f;
  }

  std::span<const Point> sites_;
  Point center_;
  const TriangulationArrays& arrays_;
  Frame frame_;
  DirectionGrid grid_;
  std::vector<bool> is_ghost_;
  Index first_solid_ = 0;
  std::vector<Cone> cones_;  // of all faces, when there are many hidden sites
  Cone cone_{};
  std::vector<Index> starts_;
  std::vector<Index> first_at_;
};

}  // namespace

void assign_hidden_faces(std::span<const Point> sites, const Point& center,
                         TriangulationArrays& arrays) {
  if (arrays.dimension < 2 || arrays.hidden.empty()) return;
  FaceFinder finder(sites, center, arrays);
  for (Hidden& h : arrays.hidden) h.face = finder.face_above(sites[h.site]);
}

}  // namespace rondel::incremental
