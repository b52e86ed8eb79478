// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cells of a diagram as a planar map: polygons that fit together without gaps or overlaps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "map/polygon.h"
#include "rondel/diagram.h"
#include "rondel/triangulation.h"

namespace rondel::map {

// Four things concern more than one cell:
// 1. Points nearer to each other than merge_distance become one point, for all cells: between
//    cocircular sites the order of the circumcenters is rounding.
// 2. Between close sites the arc between their cells is densified to an eighth of the angle between
//    them, farther from them to an eighth of the distance: so each polygon contains its site.
// 3. Where the lines of a cell cross, as it is narrower than the tolerance resolves, each arc gets
//    the points opposite those of the other, for the cells on both sides of it: lines between
//    opposite points are as good as parallel, however near. Where they are nearer than
//    merge_distance they become the same. An arc at a tip that is very short shrinks to a point.
// 4. Cells of circles need not contain their sites, and may be far narrower than sites are apart:
//    2 says nothing about them. Where their lines cross, or all have passed those of the
//    other side, they are bisected on their arcs before 3, until they are short.
// 5. Where lines of a cell still cross after that, by exact signs of rounded positions, all cells are settled_regions().
//
// Most cells are plain: small and with few corners, each arc one straight line, nothing crossed. A
// plain cell is its points, which are placed on the map once for all cells; all others are drawn.
class CellMap {
 public:
  CellMap(const Triangulation& triangulation, const Cells& cells, double tolerance_deg,
          const Execution& execution);

  // Whether the site has a cell.
  [[nodiscard]] bool has_cell(std::size_t site) const;

  // Asks for what polygons() will read, which may be far from what it read before.
  void prefetch(std::size_t site) const;

  // Memory for drawing a cell; one for each thread.
  class Pen;

  // The polygons of a site's cell, valid and without holes, until the pen is used again; none if the cell is no wider
  // than rounding.
  [[nodiscard]] const std::vector<LonLatPolygon>& polygons(std::size_t site, Pen& pen) const;

 private:
  using Edge = std::pair<Index, Index>;  // two points, the lower one first
  using LinePair = std::pair<std::size_t, std::size_t>;

  // Points of an edge between its ends, in any order.
  struct Inner {
    std::vector<Point> kept;
    std::vector<Point> dropped;
  };

  // The ring of a cell: its points and those that bisect its arcs further.
  struct Ring {
    std::vector<Point> points;
    std::vector<ArcTolerance> tolerances;  // of the arcs from each point
    std::vector<Edge> edges;               // of the diagram, on which they lie
  };

  void find_directions(const Execution& execution);
  void list_cells();
  void prefetch_listed(std::size_t cell) const;
  void merge_close_points(const Execution& execution);
  void place_points(const Execution& execution);
  [[nodiscard]] bool find_plain(std::size_t site, Pen& pen) const;
  [[nodiscard]] Index representative(Index point) const;
  Index find_representative(Index point);
  [[nodiscard]] std::vector<LinePair> crossed_lines(const Trace& trace) const;
  [[nodiscard]] std::vector<std::size_t> find_crossing_lines(const Execution& execution);
  void resolve_crossing_lines(const Execution& execution);
  bool resolve_crossing_lines(std::size_t site);
  bool bisect(std::span<const LinePair> pairs, double shortest);
  [[nodiscard]] std::map<Edge, Inner> drawn_points(std::span<const LinePair> pairs) const;
  bool align(std::span<const LinePair> pairs);
  bool align(std::size_t line, const Edge& other, const Point& p, std::map<Edge, Inner>& drawn);
  bool merge_vertices(const Edge& edge, const Point& p, const Edge& other, const Point& q);
  void keep(std::map<Edge, Inner>& drawn);
  [[nodiscard]] const Edge& edge_of(std::size_t line) const;
  [[nodiscard]] const Point& line_end(std::size_t line) const;
  [[nodiscard]] bool is_end(const Edge& edge, const Point& p) const;
  bool merge(const Edge& edge, const ArcTolerance& tolerance);
  [[nodiscard]] bool has_changed_arc(std::size_t site) const;
  bool draw_ring(std::size_t site, Ring& ring, Trace& trace) const;
  void add_arc(Index from, Index to, const ArcTolerance& tolerance, Ring& ring) const;
  [[nodiscard]] ArcTolerance tolerance_between(const Point& own_direction, std::size_t other) const;
  [[nodiscard]] bool has_invalid(const Execution& execution) const;
  [[nodiscard]] bool is_unchanged(std::size_t site) const;
  void settle(const Execution& execution);
  [[nodiscard]] std::vector<std::vector<LonLat>> loops_of(std::size_t site, Pen& pen) const;
  void prepare_great_circle();
  [[nodiscard]] ArcTolerance great_circle_tolerance(Index from, Index to) const;
  [[nodiscard]] std::span<const Index> points_of(std::size_t site) const;

  std::span<const Point> sites_;
  const Triangulation& triangulation_;
  const Cells& cells_;
  double tolerance_;               // radians
  ArcTolerance circle_tolerance_;  // below dimension 2
  Point axis_{};                   // of the great circle of the sites in dimension 1
  std::size_t only_vertex_;
  std::vector<Point> directions_;  // of the sites, from the center
  std::vector<Index> representatives_;
  std::vector<Index> cells_in_order_;   // sites, those next to each other close together
  std::vector<LonLat> positions_;       // of the points
  std::vector<std::uint8_t> is_plain_;  // whether find_plain() is true; of sites
  std::map<Edge, std::vector<Point>> inner_points_;  // from the lower point on
  std::set<Index> merged_;                           // where lines crossed
  std::set<std::size_t> unresolved_;                 // cells whose lines cross
  Ring ring_;                                        // of the cell that is being resolved
  Trace trace_;                                      // of that cell
  std::vector<std::vector<LonLatPolygon>> settled_;  // of all sites, if any
};

class CellMap::Pen {
  friend class CellMap;
  Ring ring_;
  Trace trace_;
  std::vector<LonLat> positions_;
  std::vector<LonLatPolygon> polygons_;
};

}  // namespace rondel::map
