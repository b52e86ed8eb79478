// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cells of a diagram as a planar map: polygons that fit together without gaps or overlaps.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "io/lonlat_polygon.h"
#include "rondel/diagram.h"
#include "rondel/triangulation.h"

namespace rondel::io {

// Three things concern more than one cell:
// 1. Points nearer to each other than merge_distance become one point, for all cells: between
//    cocircular sites the order of the circumcenters is rounding.
// 2. The arc between the cells of two sites is densified to an eighth of the angle between the
//    sites, or finer: so the polygon of a site, half that angle away, still contains it.
// 3. Where the lines of a cell cross, at a tip sharper than the tolerance resolves, both arcs are
//    bisected until they do not; these points belong to the cells on both sides.
class CellMap {
 public:
  CellMap(std::span<const Point> sites, const Triangulation& triangulation, const Cells& cells,
          double tolerance_deg, const Progress& progress);

  // Whether the site has a cell.
  [[nodiscard]] bool has_cell(std::size_t site) const;

  // The polygons of a site's cell; none if the cell is no wider than rounding.
  [[nodiscard]] std::vector<LonLatPolygon> polygons(std::size_t site);

 private:
  using Edge = std::pair<Index, Index>;  // two points, the lower one first

  // The ring of a cell: its points and those that bisect its arcs further.
  struct Ring {
    std::vector<Point> points;
    std::vector<double> tolerances;  // of the arcs from each point
    std::vector<Edge> edges;         // of the diagram, on which they lie
  };

  void merge_close_points();
  Index representative(Index point);
  void bisect_crossing_lines(const Progress& progress);
  bool bisect_crossing_lines(std::size_t site);
  bool bisect(const Edge& edge, std::span<const std::size_t> lines);
  [[nodiscard]] bool meets_bisected_arc(std::size_t site) const;
  bool draw_ring(std::size_t site);
  void add_arc(Index from, Index to, double tolerance);
  [[nodiscard]] Point direction(std::size_t site) const;
  [[nodiscard]] double arc_tolerance(const Point& own_direction, std::size_t other) const;
  [[nodiscard]] double least_tolerance() const;
  [[nodiscard]] std::span<const Index> points_of(std::size_t site) const;

  std::span<const Point> sites_;
  const Triangulation& triangulation_;
  const Cells& cells_;
  double tolerance_;        // radians
  double least_tolerance_;  // below dimension 2, of all arcs
  std::size_t only_vertex_;
  std::vector<Index> representatives_;
  std::map<Edge, std::vector<Point>> bisected_;  // from the lower point on
  Ring ring_;                                    // of the cell that is being drawn
  Trace trace_;                                  // of that cell
};

}  // namespace rondel::io
