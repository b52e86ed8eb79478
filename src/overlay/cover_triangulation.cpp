// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/cover_triangulation.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "exact/vector.h"
#include "overlay/side_table.h"
#include "overlay/snapped_sides.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "system/parallel.h"
#include "system/stage_progress.h"

namespace rondel::overlay {
namespace {

constexpr Halfedge sides_per_step = 1024;
constexpr std::array<Point, 6> axis_ends = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};

// A triangulation of the sphere, represented by the directed sides of its triangles, into which the
// sides of cells are inserted.
class SideMesh {
 public:
  // `names_of_cells` are the indices of the cells in the input, for messages.
  SideMesh(std::vector<Point> points, std::span<const Index> names_of_cells,
           const Execution& execution)
      : points_(std::move(points)),
        names_of_cells_(names_of_cells),
        names_(points_.size()),
        around_(points_.size(), no_index),
        sides_(6 * points_.size()) {
    const Triangulation triangulation = delaunay(points_, {}, execution);
    for (Index p = 0; p < names_.size(); ++p) names_[p] = p;
    for (const auto& [site, representative] : triangulation.duplicates()) {
      names_[site] = representative;
    }
    for (const Triple& face : triangulation.faces()) add(face[0], face[1], face[2]);
  }

  // Inserts the arc from p to q with the cell `owner` to its left. The arc becomes one or more
  // sides of triangles.
  void put(Index p, Index q, Index owner) {
    Index at = names_[p];
    const Index end = names_[q];
    while (at != end) {
      const Index next = put_first(at, end, owner);
      Index& back = sides_.make(next, at).owner;
      if (back == owner) {  // the owner has the side in both directions
        back = no_index;
        has_to_and_fro_ = true;
      } else {
        Index& there = sides_.make(at, next).owner;
        if (there != no_index) refuse(owner, there, points_[at] + points_[next], false);
        there = owner;
      }
      at = next;
    }
  }
  // True if a side of one owner was inserted in both directions.
  [[nodiscard]] bool has_to_and_fro() const { return has_to_and_fro_; }
  // Returns the triangles and the cell of each (no_index for none). Throws ConflictingSides if
  // cells overlap.
  void take(CellRings& triangles, std::vector<Index>& owners);

 private:
  [[nodiscard]] Index apex(Index from, Index to) const { return sides_.at(from, to).apex; }
  // Returns positive if c is to the left of the great circle from a to b.
  [[nodiscard]] Sign turn(Index a, Index b, Index c) const {
    return orientation(points_[a], points_[b], points_[c]);
  }
  // Adds a triangle.
  void add(Index a, Index b, Index c) {
    sides_.make(a, b).apex = c;
    sides_.make(b, c).apex = a;
    sides_.make(c, a).apex = b;
    around_[a] = b;
    around_[b] = c;
    around_[c] = a;
  }
  Index put_first(Index p, Index q, Index owner);
  [[noreturn]] void refuse(Index owner, Index other, const Point& towards, bool is_crossing) const;
  // Throws ConflictingSides if the side ab, which the path from p to q crosses, bounds a cell.
  void refuse_if_crossed(Index a, Index b, Index p, Index q, Index owner) const;
  [[nodiscard]] std::vector<Index> owners_of(std::span<const Index> corners) const;
  // Triangulates a polygon by cutting off ears.
  void fill(std::vector<Index> ring);
  [[nodiscard]] bool is_ear(const std::vector<Index>& ring, std::size_t k) const;

  std::vector<Point> points_;
  std::span<const Index> names_of_cells_;
  std::vector<Index> names_;   // for each point the first one in the same direction
  std::vector<Index> around_;  // for each point the end of some side that begins there
  bool has_to_and_fro_ = false;
  SideTable sides_;  // has the sides that were crossed as well; their apexes are not read any more
};

void SideMesh::refuse(Index owner, Index other, const Point& towards, bool is_crossing) const {
  const auto [first, second] = std::minmax({names_of_cells_[owner], names_of_cells_[other]});
  throw ConflictingSides({first, second, normalized(towards), is_crossing});
}

void SideMesh::refuse_if_crossed(Index a, Index b, Index p, Index q, Index owner) const {
  for (const TriangleSide& side : {sides_.at(a, b), sides_.at(b, a)}) {
    if (side.owner == no_index) continue;
    const Point& from = points_[p];
    const Point& start = points_[a];
    const Point place = cross(cross(from, points_[q] - from), cross(start, points_[b] - start));
    const Point middle = start + points_[b];
    refuse(owner, side.owner,
           place == Point{} ? middle : (dot(place, middle) < 0 ? -1.0 : 1.0) * place, true);
  }
}

// Makes a side of the beginning of the arc from p to q, up to the first point on it, and returns
// that point. All sides that it crosses are removed; the points to its left, and those to its
// right, are the corners of two polygons, which are triangulated.
Index SideMesh::put_first(Index p, Index q, Index owner) {
  Index a = around_[p];
  Index b = apex(p, a);
  while (turn(p, a, q) == Sign::negative || turn(p, q, b) != Sign::positive) {
    a = b;
    b = apex(p, a);
    if (a != around_[p]) continue;
    // A side to the antipode has no direction.
    throw InvalidInput("a side is 180 degrees long", names_of_cells_[owner]);
  }
  if (turn(p, a, q) == Sign::zero) return a;
  std::vector<Index> left = {b};
  std::vector<Index> right = {a};
  for (;;) {
    refuse_if_crossed(a, b, p, q, owner);
    const Index c = apex(b, a);
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

// True if corner k and its neighbors form a triangle inside of the polygon with no other corner in
// it or on it.
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

void SideMesh::take(CellRings& triangles, std::vector<Index>& owners) {
  triangles.points = points_;
  for (Index p = 0; p < points_.size(); ++p) {
    if (around_[p] == no_index) continue;
    Index a = around_[p];
    do {
      const Index b = apex(p, a);
      if (p < a && p < b) {
        const auto name = static_cast<Index>(triangles.num_cells());
        triangles.append_ring(std::array{p, a, b});
        triangles.end_cell();
        for (const auto& [from, to] : {std::pair(p, a), {a, b}, {b, p}}) {
          sides_.make(from, to).triangle = name;
        }
      }
      a = b;
    } while (a != around_[p]);
  }
  owners = owners_of(triangles.corners);
}

// Returns the cells of the triangles with these corners. A cell has all triangles to the left of
// its sides, and from them all triangles beyond sides that bound nothing: sides that no cell has,
// or that one cell has in both directions.
std::vector<Index> SideMesh::owners_of(std::span<const Index> corners) const {
  // The cells on both sides of a triangle's side, if they differ.
  struct Bounds {
    Index left;
    Index right;
    Index beyond;  // the triangle to the right
  };
  std::vector<Bounds> bounds(corners.size());
  for (std::size_t at = 0; at < corners.size(); ++at) {
    const Index p = corners[at];
    const Index q = corners[at % 3 == 2 ? at - 2 : at + 1];
    const TriangleSide& side = sides_.at(p, q);
    const TriangleSide& back = sides_.at(q, p);
    const bool is_none = side.owner == back.owner;
    bounds[at] = {is_none ? no_index : side.owner, is_none ? no_index : back.owner, back.triangle};
  }
  std::vector<Index> owners(corners.size() / 3, no_index);
  std::vector<Index> waiting;
  const auto visit = [&](Index triangle, Index owner) {
    if (owners[triangle] != no_index) return;
    owners[triangle] = owner;
    waiting.push_back(triangle);
  };
  const auto bounds_of = [&](Index triangle) {
    return std::span(bounds).subspan(3 * std::size_t{triangle}, 3);
  };
  for (Index triangle = 0; triangle < owners.size(); ++triangle) {
    for (const Bounds& side : bounds_of(triangle)) {
      if (side.left != no_index) visit(triangle, side.left);
    }
    while (!waiting.empty()) {
      const Index from = waiting.back();
      waiting.pop_back();
      for (const auto& [left, right, beyond] : bounds_of(from)) {
        if (left == no_index && right == no_index) visit(beyond, owners[from]);
      }
    }
  }
  // If the triangle to the left of a cell's side belongs to another cell, or the triangle to the
  // right of it to any cell, then cells overlap in it.
  for (Index triangle = 0; triangle < owners.size(); ++triangle) {
    const Index owner = owners[triangle];
    for (const auto& [left, right, beyond] : bounds_of(triangle)) {
      const Point& a = points_[corners[3 * std::size_t{triangle}]];
      const Point middle = a + points_[corners[3 * std::size_t{triangle} + 1]] +
                           points_[corners[3 * std::size_t{triangle} + 2]];
      if (left != no_index && left != owner) refuse(left, owner, middle, false);
      if (left == no_index && right != no_index && owner != no_index) {
        refuse(right, owner, middle, false);
      }
    }
  }
  return owners;
}

}  // namespace

ConflictingSides::ConflictingSides(const SideConflict& conflict)
    : InvalidInput(conflict.first == conflict.second
                       ? "cell " + std::to_string(conflict.first) + " overlaps itself"
                       : "cells " + std::to_string(conflict.first) + " and " +
                             std::to_string(conflict.second) + " overlap",
                   conflict.second),
      conflict_(conflict) {}

namespace {

// Returns the sides of all cells with their cells.
std::vector<OwnedSide> owned_sides(const Subdivision& cells) {
  std::vector<OwnedSide> sides;
  sides.reserve(cells.num_halfedges());
  for (Index ring = 0; ring + 1 < cells.rings.size(); ++ring) {
    const Halfedge first = cells.rings[ring];
    const Halfedge end = cells.rings[ring + 1];
    for (Halfedge h = first; h < end; ++h) {
      sides.push_back(
          {cells.corners[h], cells.corners[h + 1 == end ? first : h + 1], cells.cell_of[h]});
    }
  }
  return sides;
}

// The triangles and their cells after inserting all sides.
struct FilledSides {
  CellRings triangles;
  std::vector<Index> owners;
  bool has_to_and_fro;
};
FilledSides filled_with(const Subdivision& cells, std::span<const OwnedSide> sides,
                        const Execution& execution) {
  std::vector<Point> points = cells.points;
  points.insert(points.end(), axis_ends.begin(), axis_ends.end());
  SideMesh mesh(std::move(points), cells.names, execution);
  system::StageProgress progress(execution.progress, "fill",
                                 system::num_pieces(sides.size(), sides_per_step));
  for (std::size_t k = 0; k < sides.size(); ++k) {
    mesh.put(sides[k].from, sides[k].to, sides[k].owner);
    if ((k + 1) % sides_per_step != 0 && k + 1 != sides.size()) continue;
    system::obey_stop();
    progress.step();
  }
  FilledSides filled;
  mesh.take(filled.triangles, filled.owners);
  filled.has_to_and_fro = mesh.has_to_and_fro();
  return filled;
}

// Triangulates cells. If cells overlap only because corners are beside sides on which they are up
// to rounding, these corners become corners of the sides. That may move sides across other corners,
// so it is repeated. An overlap that is wider, but too short for overlaps_of() to report it, needs
// larger steps.
FilledSides filled_by_rounding(const Subdivision& cells, const Execution& execution) {
  constexpr std::array<double, 4> steps = {1, 1, 16, 512};
  std::vector<OwnedSide> sides = owned_sides(cells);
  try {
    return filled_with(cells, sides, execution);
  } catch (const ConflictingSides&) {
    for (const double step : steps) {
      const Snaps snaps(cells.points, sides, step * snapping_distance);
      if (snaps.is_empty()) continue;
      sides = snaps.applied(sides);
      try {
        return filled_with(cells, sides, {.threads = execution.threads, .stop = execution.stop});
      } catch (const ConflictingSides&) {
        continue;
      }
    }
    throw;
  }
}

}  // namespace

std::optional<SideConflict> side_conflict(const Subdivision& cells, const Execution& execution) {
  try {
    filled_with(cells, owned_sides(cells), execution);
  } catch (const ConflictingSides& error) {
    return error.conflict();
  }
  return std::nullopt;
}

bool has_plain_sides(const Subdivision& cells, const Execution& execution) {
  try {
    return !filled_with(cells, owned_sides(cells), execution).has_to_and_fro;
  } catch (const ConflictingSides&) {
    return false;
  }
}

bool is_region(std::span<const BorderArc> sides, const Execution& execution) {
  std::vector<Point> points;
  for (const auto& [from, to] : sides) {
    points.push_back(from);
    points.push_back(to);
  }
  points.insert(points.end(), axis_ends.begin(), axis_ends.end());
  const Index owner = 0;
  SideMesh mesh(std::move(points), std::span(&owner, 1), execution);
  try {
    for (Index k = 0; k < sides.size(); ++k) mesh.put(2 * k, 2 * k + 1, owner);
    std::pair<CellRings, std::vector<Index>> filled;
    mesh.take(filled.first, filled.second);
  } catch (const ConflictingSides&) {
    return false;
  }
  return true;
}

CoverTriangulation triangulate_cover(const Subdivision& cells, const Execution& execution) {
  const auto [triangles, owners_by_name, has_to_and_fro] = filled_by_rounding(cells, execution);
  CoverTriangulation completed{Subdivision(triangles, false, execution.threads), {}};
  const auto none = static_cast<Index>(cells.num_cells());
  for (const Index name : completed.cover.names) {
    completed.owners.push_back(std::min(owners_by_name[name], none));
  }
  return completed;
}

}  // namespace rondel::overlay
