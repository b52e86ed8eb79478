// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Draws the cells of a diagram as a planar map: polygons in longitude and latitude that fit
// together without gaps or overlaps.
//
// in    a triangulation and its cells, a tolerance in degrees
// out   polygons in degrees for each site
// index sites; points of the diagram (Index, as in Cells::points); lines of a drawn ring by their
//       first points
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

// Draws one cell at a time. Some decisions concern several cells and are made by the constructor:
//
// 1. Points nearer to each other than merge_distance become one point for all cells: the order of
//    the circumcenters of cocircular sites is decided by rounding.
// 2. Near two close sites the arc between their cells is densified to an eighth of the angle
//    between the sites, and farther away to an eighth of the distance. So each polygon contains its
//    site.
// 3. Where the lines of a cell cross, because the cell is narrower than the tolerance, each arc
//    gets the points opposite those of the other arc, for the cells on both sides: lines between
//    opposite points are nearly parallel. Where such points are nearer than merge_distance they are
//    merged. A very short arc at a tip shrinks to a point.
// 4. Cells of circles need not contain their sites and may be far narrower than the distances of
//    sites, so that 2 does not help. Where their lines cross, or have all passed those of the other
//    side, the lines are bisected on their arcs before 3, until they are short.
// 5. If lines of any cell cross after that, by exact signs of rounded positions, all cells are
//    replaced by settled_regions().
//
// Most cells are plain: small and with few corners, each arc drawn as one straight line, and
// nothing crosses. A plain cell has just its points, whose positions are computed once for all
// cells. Other cells are drawn.
class CellMap {
 public:
  CellMap(const Triangulation& triangulation, const Cells& cells, double tolerance_deg,
          const Execution& execution);

  // True if the site has a cell.
  [[nodiscard]] bool has_cell(std::size_t site) const;

  // Prefetches the memory that polygons(site) will read, which may be far from what was read
  // before.
  void prefetch(std::size_t site) const;

  // The working memory for drawing a cell. Each thread needs its own.
  class Pen;

  // Returns the polygons of a site's cell: valid, without holes, and empty if the cell is no wider
  // than rounding. The reference is valid until the pen is used again.
  [[nodiscard]] const std::vector<LonLatPolygon>& polygons(std::size_t site, Pen& pen) const;

 private:
  using Edge = std::pair<Index, Index>;  // two points of the diagram, the lower index first
  // Two lines of a drawn ring.
  using LinePair = std::pair<std::size_t, std::size_t>;

  // The points of an edge between its ends, in no order: those that stay and those that are
  // removed.
  struct Inner {
    std::vector<Point> kept;
    std::vector<Point> dropped;
  };

  // The ring of a cell: its points and the points that bisect its arcs further.
  struct Ring {
    std::vector<Point> points;
    std::vector<ArcTolerance> tolerances;  // the tolerance of the arc that begins at each point
    std::vector<Edge> edges;               // the edge of the diagram on which each arc lies
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
  ArcTolerance circle_tolerance_;  // tolerance below dimension 2
  Point axis_{};                   // normal of the great circle of the sites in dimension 1
  // The vertex in dimension 0.
  std::size_t only_vertex_;
  std::vector<Point> directions_;  // unit vectors from the center to the sites
  // For each point, the point that it is merged with.
  std::vector<Index> representatives_;
  std::vector<Index> cells_in_order_;   // sites; neighbors are close to each other in the list
  std::vector<LonLat> positions_;       // of each point, degrees
  std::vector<std::uint8_t> is_plain_;  // for each site, the result of find_plain()
  // The points that divide an edge, from its lower end on.
  std::map<Edge, std::vector<Point>> inner_points_;
  std::set<Index> merged_;            // points that were merged because lines crossed
  std::set<std::size_t> unresolved_;  // sites whose cells have crossing lines
  Ring ring_;                         // the ring of the cell that is being resolved
  Trace trace_;                       // the drawing of that cell
  // The polygons of each site if cells were settled; else empty.
  std::vector<std::vector<LonLatPolygon>> settled_;
};

class CellMap::Pen {
  friend class CellMap;
  Ring ring_;
  Trace trace_;
  std::vector<LonLat> positions_;
  std::vector<LonLatPolygon> polygons_;
};

}  // namespace rondel::map
