// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells prepared for an overlay: halfedges with their twins, in the spatial order of the cells.
//
// in    CellRings
// out   the arrays below
// index cells: places in spatial order, from 0; `names` has the index in the input of each
//       rings, halfedges, points: entries of `rings`, `corners`, `points`
//
// Halfedges here are not those of a triangulation (3 * face + i, topology/mesh.h).
//
// A halfedge leads from its corner to the next one of its ring, and its cell is to its left.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/types.h"
#include "system/large_arrays.h"

namespace rondel::overlay {

using Halfedge = Index;

// The number of cells that one task of a parallel loop takes.
inline constexpr std::size_t cells_per_task = 4096;

// The shapes of cells, which decide how a walk goes through them.
enum class Shape : std::uint8_t {
  empty,   // no ring
  convex,  // one ring, strictly convex
  // One ring in less than a hemisphere; each halfedge turns counterclockwise around the cell's
  // center.
  star,
  other,
};

// All cells of one side of an overlay.
struct Subdivision {
  // `is_rounded` says that rounding may have put corners into the wrong order; such corners are
  // merged.
  Subdivision(const CellRings& input, bool is_rounded, unsigned threads);

  std::vector<Point> points;  // in the order of their first use
  LargeVector<Index> cells;   // cell i has the rings cells[i] ... cells[i+1]-1
  LargeVector<Index> rings;   // ring r has the halfedges rings[r] ... rings[r+1]-1
  // For each ring, the number of corners in the input's ring before the one at which it begins
  // here. The array is empty if corners were merged.
  LargeVector<Index> given_starts;
  LargeVector<Index> begins;  // the halfedges of cell i are begins[i] ... begins[i+1]-1
  // The point at the origin of each halfedge.
  LargeVector<Index> corners;
  LargeVector<Halfedge> twins;  // the opposite halfedge; no_index if there is no cell beyond
  // The cell of each halfedge.
  LargeVector<Index> cell_of;
  LargeVector<Shape> shapes;
  std::vector<Point> centers;  // the directions of the centers of mass
  // The cells of Shape::other with their areas, in ascending order of cells.
  std::vector<std::pair<Index, double>> areas_of_others;
  LargeVector<Index> names;  // the index of each cell in the input
  // The places of the cells along the space-filling curve, ascending.
  std::vector<std::uint64_t> keys;
  bool is_closed = false;  // true if every halfedge has a twin and every cell is convex or a star

  [[nodiscard]] std::size_t num_cells() const { return names.size(); }
  [[nodiscard]] std::size_t num_halfedges() const { return corners.size(); }
  [[nodiscard]] Index begin_of(Index cell) const { return begins[cell]; }
  [[nodiscard]] Index end_of(Index cell) const { return begins[cell + 1]; }
  [[nodiscard]] const Point& origin(Halfedge h) const { return points[corners[h]]; }

  // Returns the next halfedge around a cell. Precondition: the cell has one ring.
  [[nodiscard]] Halfedge next(Halfedge h) const {
    const Index cell = cell_of[h];
    return h + 1 == end_of(cell) ? begin_of(cell) : h + 1;
  }
  [[nodiscard]] Halfedge previous(Halfedge h) const {
    const Index cell = cell_of[h];
    return h == begin_of(cell) ? end_of(cell) - 1 : h - 1;
  }
  [[nodiscard]] const Point& end(Halfedge h) const { return origin(next(h)); }

  [[nodiscard]] std::span<const Index> corners_of(Index ring) const {
    return std::span(corners).subspan(rings[ring], rings[ring + 1] - rings[ring]);
  }
  // Copies the corners of a ring of any cell.
  void copy_ring(Index ring, std::vector<Point>& corners_of_ring) const {
    corners_of_ring.clear();
    for (Halfedge h = rings[ring]; h < rings[ring + 1]; ++h) corners_of_ring.push_back(origin(h));
  }
  // Returns the area of a cell of Shape::other, in steradians.
  [[nodiscard]] double area_of_other(Index cell) const;
  [[nodiscard]] double area_of_rings(Index cell) const;

 private:
  void sort_cells(const CellRings& input, unsigned threads);
  void take_rings(const CellRings& input, unsigned threads);
  void number_points(std::span<const Point> given, unsigned threads);
  [[nodiscard]] bool is_in_order(Index cell) const;
  void merge_disordered(unsigned threads);
  void take_merged(std::span<const Index> merged);
  void find_begins();
  void find_shapes(unsigned threads);
  [[nodiscard]] bool is_convex(Index cell) const;
  [[nodiscard]] bool is_star(Index cell) const;
  void find_areas_of_others();
};

}  // namespace rondel::overlay
