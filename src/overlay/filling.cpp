// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/filling.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel::overlay {
namespace {

constexpr Halfedge sides_per_step = 1024;

// Triangles by their directed sides.
class SideMesh {
 public:
  // Of cells with these names, for messages.
  SideMesh(std::vector<Point> points, std::span<const Index> names_of_cells,
           const Execution& execution)
      : points_(std::move(points)),
        names_of_cells_(names_of_cells),
        names_(points_.size()),
        around_(points_.size(), no_index) {
    const Triangulation triangulation = delaunay(points_, {}, execution);
    for (Index p = 0; p < names_.size(); ++p) names_[p] = p;
    for (const auto& [site, representative] : triangulation.duplicates()) {
      names_[site] = representative;
    }
    apexes_.reserve(3 * triangulation.num_faces());
    for (const Triple& face : triangulation.faces()) add(face[0], face[1], face[2]);
  }

  // Makes the arc from p to q one or more sides of triangles with `owner` to their left.
  void put(Index p, Index q, Index owner) {
    Index at = names_[p];
    const Index end = names_[q];
    while (at != end) {
      const Index next = put_first(at, end, owner);
      const auto [there, is_new] = owners_.try_emplace(side(at, next), owner);
      if (!is_new) refuse(owner, there->second);
      at = next;
    }
  }
  // The triangles, and what they are parts of. Cells that overlap are refused.
  void take(CellRings& triangles, std::vector<Index>& owners) const;

 private:
  static std::uint64_t side(Index from, Index to) { return std::uint64_t{from} << 32U | to; }
  [[nodiscard]] Index apex(Index from, Index to) const { return apexes_.at(side(from, to)); }
  [[nodiscard]] Sign turn(Index a, Index b, Index c) const {
    return orientation(points_[a], points_[b], points_[c]);
  }
  void add(Index a, Index b, Index c) {
    apexes_[side(a, b)] = c;
    apexes_[side(b, c)] = a;
    apexes_[side(c, a)] = b;
    around_[a] = b;
    around_[b] = c;
    around_[c] = a;
  }
  void remove(Index a, Index b, Index c) {
    apexes_.erase(side(a, b));
    apexes_.erase(side(b, c));
    apexes_.erase(side(c, a));
  }
  Index put_first(Index p, Index q, Index owner);
  [[noreturn]] void refuse(Index owner, Index other) const;
  void refuse_if_crossed(Index a, Index b, Index owner) const;
  [[nodiscard]] Index owner_beside(Index from, Index to) const;
  [[nodiscard]] std::vector<Index> owners_of(
      std::span<const Index> corners, const std::unordered_map<std::uint64_t, Index>& names) const;
  void fill(std::vector<Index> ring);
  [[nodiscard]] bool is_ear(const std::vector<Index>& ring, std::size_t k) const;

  std::vector<Point> points_;
  std::span<const Index> names_of_cells_;
  std::vector<Index> names_;   // of points in the same direction, one
  std::vector<Index> around_;  // an end of a side from each point
  std::unordered_map<std::uint64_t, Index> apexes_;
  std::unordered_map<std::uint64_t, Index>
      owners_;  // of sides that were put, what is to their left
};

void SideMesh::refuse(Index owner, Index other) const {
  const auto [first, second] = std::minmax({names_of_cells_[owner], names_of_cells_[other]});
  throw InvalidInput(first == second ? "cell " + std::to_string(first) + " overlaps itself"
                                     : "cells " + std::to_string(first) + " and " +
                                           std::to_string(second) + " overlap",
                     second);
}

void SideMesh::refuse_if_crossed(Index a, Index b, Index owner) const {
  for (const std::uint64_t key : {side(a, b), side(b, a)}) {
    const auto other = owners_.find(key);
    if (other != owners_.end()) refuse(owner, other->second);
  }
}

// Makes a side of the beginning of the arc from p to q, up to the first point on it, which is returned. All sides that
// it crosses vanish: the points to its left, and those to its right, are then corners of two polygons along it.
Index SideMesh::put_first(Index p, Index q, Index owner) {
  Index a = around_[p];
  Index b = apex(p, a);
  while (turn(p, a, q) == Sign::negative || turn(p, q, b) != Sign::positive) {
    a = b;
    b = apex(p, a);
    if (a != around_[p]) continue;
    throw InvalidInput("a side is 180 degrees long", names_of_cells_[owner]);  // in no direction
  }
  if (turn(p, a, q) == Sign::zero) return a;
  std::vector<Index> left = {b};
  std::vector<Index> right = {a};
  remove(p, a, b);
  for (;;) {
    refuse_if_crossed(a, b, owner);
    const Index c = apex(b, a);
    remove(b, a, c);
    const Sign at = turn(p, q, c);
    if (at == Sign::zero) {
      left.insert(left.end(), {c, p});
      std::ranges::reverse(left);
      right.insert(right.begin(), p);
      right.push_back(c);
      fill(std::move(left));
      fill(std::move(right));
      return c;
    }
    (at == Sign::positive ? left : right).push_back(c);
    (at == Sign::positive ? b : a) = c;
  }
}

// Corner k and its neighbors make a triangle inside the ring that no other corner is in or on.
bool SideMesh::is_ear(const std::vector<Index>& ring, std::size_t k) const {
  const std::size_t n = ring.size();
  const Index a = ring[(k + n - 1) % n];
  const Index b = ring[k];
  const Index c = ring[(k + 1) % n];
  if (turn(a, b, c) != Sign::positive) return false;
  return std::ranges::none_of(ring, [&](Index d) {
    return d != a && d != b && d != c && turn(a, b, d) != Sign::negative &&
           turn(b, c, d) != Sign::negative && turn(c, a, d) != Sign::negative;
  });
}

void SideMesh::fill(std::vector<Index> ring) {
  while (ring.size() > 3) {
    std::size_t k = 0;
    while (!is_ear(ring, k)) ++k;
    const std::size_t n = ring.size();
    add(ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]);
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(k));
  }
  add(ring[0], ring[1], ring[2]);
}

void SideMesh::take(CellRings& triangles, std::vector<Index>& owners) const {
  triangles.points = points_;
  std::unordered_map<std::uint64_t, Index> names;
  names.reserve(apexes_.size());
  for (Index p = 0; p < points_.size(); ++p) {
    if (around_[p] == no_index) continue;
    Index a = around_[p];
    do {
      const Index b = apex(p, a);
      if (p < a && p < b) {
        const auto name = static_cast<Index>(triangles.num_cells());
        triangles.corners.insert(triangles.corners.end(), {p, a, b});
        triangles.rings.push_back(triangles.corners.size());
        triangles.cells.push_back(triangles.rings.size() - 1);
        for (const auto key : {side(p, a), side(a, b), side(b, p)}) names[key] = name;
      }
      a = b;
    } while (a != around_[p]);
  }
  owners = owners_of(triangles.corners, names);
}

// What a side that was put bounds to its left; no_index where a cell has it in both directions, which bounds nothing.
Index SideMesh::owner_beside(Index from, Index to) const {
  const auto there = owners_.find(side(from, to));
  if (there == owners_.end()) return no_index;
  const auto back = owners_.find(side(to, from));
  return back != owners_.end() && back->second == there->second ? no_index : there->second;
}

// Of the triangles with these corners, which `names` has by their sides. A cell has all triangles that are beside its
// sides, and what is beyond these through sides that bound nothing.
std::vector<Index> SideMesh::owners_of(
    std::span<const Index> corners, const std::unordered_map<std::uint64_t, Index>& names) const {
  std::vector<Index> owners(corners.size() / 3, no_index);
  std::vector<Index> waiting;
  const auto visit = [&](Index triangle, Index owner) {
    if (owners[triangle] != no_index) return;
    owners[triangle] = owner;
    waiting.push_back(triangle);
  };
  // Of each side its ends, and what is bounded to its left and to its right.
  const auto for_each_side = [&](Index triangle, const auto& take) {
    for (Index k = 0; k < 3; ++k) {
      const Index p = corners[3 * std::size_t{triangle} + k];
      const Index q = corners[3 * std::size_t{triangle} + (k + 1) % 3];
      take(p, q, owner_beside(p, q), owner_beside(q, p));
    }
  };
  for (Index triangle = 0; triangle < owners.size(); ++triangle) {
    for_each_side(triangle, [&](Index, Index, Index left, Index) {
      if (left != no_index) visit(triangle, left);
    });
    while (!waiting.empty()) {
      const Index from = waiting.back();
      waiting.pop_back();
      for_each_side(from, [&](Index p, Index q, Index left, Index right) {
        if (left == no_index && right == no_index) visit(names.at(side(q, p)), owners[from]);
      });
    }
  }
  // A triangle of a cell beside the side of another one, or outside of a side of its own, is in both.
  for (Index triangle = 0; triangle < owners.size(); ++triangle) {
    for_each_side(triangle, [&](Index, Index, Index left, Index right) {
      const Index owner = owners[triangle];
      if (left != no_index && left != owner) refuse(left, owner);
      if (left == no_index && right != no_index && owner != no_index) refuse(right, owner);
    });
  }
  return owners;
}

}  // namespace

Filling filling_of(const Subdivision& cells, const Execution& execution) {
  std::vector<Point> points = cells.points;
  points.insert(points.end(),
                {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  SideMesh mesh(std::move(points), cells.names, execution);
  system::StageProgress progress(execution.progress, "fill",
                                 system::num_pieces(cells.num_halfedges(), sides_per_step));
  for (Index ring = 0; ring + 1 < cells.rings.size(); ++ring) {
    const Halfedge first = cells.rings[ring];
    const Halfedge end = cells.rings[ring + 1];
    for (Halfedge h = first; h < end; ++h) {
      mesh.put(cells.corners[h], cells.corners[h + 1 == end ? first : h + 1], cells.cell_of[h]);
      if ((h + 1) % sides_per_step != 0 && h + 1 != cells.num_halfedges()) continue;
      system::obey_stop();
      progress.step();
    }
  }
  CellRings triangles;
  std::vector<Index> owners_by_name;
  mesh.take(triangles, owners_by_name);
  Filling filling{Subdivision(triangles, false, execution.threads), {}};
  const auto none = static_cast<Index>(cells.num_cells());
  for (const Index name : filling.cover.names) {
    filling.owners.push_back(std::min(owners_by_name[name], none));
  }
  return filling;
}

}  // namespace rondel::overlay
