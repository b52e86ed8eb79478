// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/cell_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "map/trace.h"
#include "system/parallel.h"
#include "system/prefetch.h"
#include "topology/mesh.h"

namespace rondel::map {

CellMap::CellMap(const Triangulation& triangulation, const Cells& cells, double tolerance_deg,
                 const Execution& execution)
    : sites_(triangulation.sites().points()),
      triangulation_(triangulation),
      cells_(cells),
      tolerance_(tolerance_deg / degrees_per_radian),
      only_vertex_(triangulation.dimension() == 0 ? triangulation.ring().front() : sites_.size()),
      directions_(sites_.size()),
      representatives_(cells.points.size()),
      is_plain_(sites_.size()) {
  find_directions(execution);
  if (triangulation.dimension() == 1) prepare_great_circle();
  list_cells();
  merge_close_points(execution);
  place_points(execution);
  resolve_crossing_lines(execution);
  if (!unresolved_.empty() || has_invalid(execution)) settle(execution);
}

bool CellMap::has_cell(std::size_t site) const {
  return site == only_vertex_ || !points_of(site).empty();
}

const std::vector<LonLatPolygon>& CellMap::polygons(std::size_t site, Pen& pen) const {
  if (!settled_.empty()) return settled_[site];
  if (is_unchanged(site)) {
    pen.polygons_.resize(1);
    std::vector<LonLat>& ring = pen.polygons_.front().ring;
    ring.clear();
    for (const Index point : points_of(site)) ring.push_back(positions_[point]);
    ring.push_back(positions_[points_of(site).front()]);
  } else if (site == only_vertex_) {
    pen.polygons_ = lonlat_polygons({}, {});
  } else if (!draw_ring(site, pen.ring_, pen.trace_)) {
    pen.polygons_.clear();
  } else {
    pen.polygons_ = polygons_of(pen.trace_);
  }
  return pen.polygons_;
}

// True if the cell is drawn as the polygon of its own points.
bool CellMap::is_unchanged(std::size_t site) const {
  return is_plain_[site] != 0 &&
         ((inner_points_.empty() && merged_.empty()) || !has_changed_arc(site));
}

std::span<const Index> CellMap::points_of(std::size_t site) const { return cells_.rings[site]; }

Index CellMap::representative(Index point) const {
  while (representatives_[point] != point) point = representatives_[point];
  return point;
}

// Returns the point that a point is merged with, and shortens the path to it.
Index CellMap::find_representative(Index point) {
  while (representatives_[point] != point) {
    representatives_[point] = representatives_[representatives_[point]];
    point = representatives_[point];
  }
  return point;
}

// Lists the sites with cells in the order in which they first occur as corners of faces. Faces are
// in spatial order, so each cell is near the one before it. In the order of sites its points would
// be in no cache.
void CellMap::list_cells() {
  std::vector<std::uint8_t> is_listed(sites_.size());
  const auto add = [&](std::size_t site) {
    if (is_listed[site] != 0 || points_of(site).empty()) return;
    is_listed[site] = 1;
    cells_in_order_.push_back(static_cast<Index>(site));
  };
  cells_in_order_.reserve(sites_.size());
  for (const Triple& face : triangulation_.faces()) std::ranges::for_each(face, add);
  // Adds the rest below dimension 2.
  for (std::size_t site = 0; site < sites_.size(); ++site) add(site);
}

// Prefetches what polygons() reads for the cells that follow in the list, in two steps: the offsets
// of a cell far ahead, and the points of one less far. The distance changes nothing but speed.
void CellMap::prefetch_listed(std::size_t cell) const {
  constexpr std::size_t prefetch_distance = 128;
  if (cell + 2 * prefetch_distance < cells_in_order_.size()) {
    system::prefetch(&cells_.rings.offsets[cells_in_order_[cell + 2 * prefetch_distance]]);
  }
  if (cell + prefetch_distance < cells_in_order_.size()) {
    const Index site = cells_in_order_[cell + prefetch_distance];
    system::prefetch(cells_.rings.values.data() + cells_.rings.offsets[site]);
    system::prefetch(&directions_[site]);
  }
}

void CellMap::prefetch(std::size_t site) const {
  for (const Index point : points_of(site)) system::prefetch(&positions_[point]);
}

// The representative of a set of merged points is the lowest point, in whatever order points are
// merged.
void CellMap::merge_close_points(const Execution& execution) {
  std::iota(representatives_.begin(), representatives_.end(), Index{0});
  constexpr std::size_t grain = 4096;
  const std::size_t num_cells = cells_in_order_.size();
  std::vector<std::vector<Edge>> close(system::num_pieces(num_cells, grain));
  system::parallel_for(execution.threads, num_cells, grain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t cell = begin; cell < end; ++cell) {
                           prefetch_listed(cell);
                           const std::span<const Index> ring = points_of(cells_in_order_[cell]);
                           for (std::size_t i = 0; i < ring.size(); ++i) {
                             const Index p = ring[i];
                             const Index q = ring[i + 1 == ring.size() ? 0 : i + 1];
                             if (distance(cells_.points[p], cells_.points[q]) > merge_distance)
                               continue;
                             close[begin / grain].emplace_back(p, q);
                           }
                         }
                       });
  for (const std::vector<Edge>& some : close) {
    for (const auto& [p, q] : some) {
      const auto [low, high] = std::minmax({find_representative(p), find_representative(q)});
      representatives_[high] = low;
    }
  }
  for (Index& point : representatives_) point = representative(point);
}

void CellMap::find_directions(const Execution& execution) {
  constexpr std::size_t grain = 4096;
  const Point& center = triangulation_.sphere().center;
  system::parallel_for(execution.threads, sites_.size(), grain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           directions_[i] = direction(sites_[i], center);
                         }
                       });
}

void CellMap::place_points(const Execution& execution) {
  constexpr std::size_t grain = 4096;
  positions_.resize(cells_.points.size());
  system::parallel_for(execution.threads, positions_.size(), grain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           positions_[i] = map_point(snapped(cells_.points[i])).position;
                         }
                       });
}

// True if a cheap test finds that the cell is drawn as the polygon of its points and that none of
// its lines cross, as long as its points and arcs stay as they are. The positions of the points are
// left in the pen.
//
// This is the usual case of draw_ring(): the arc that follows face (a, u, v) lies between a and v.
bool CellMap::find_plain(std::size_t site, Pen& pen) const {
  const std::span<const Index> points = points_of(site);
  if (triangulation_.dimension() != 2 || points.size() > longest_plain) return false;
  const Point& own_direction = directions_[site];
  const auto a = static_cast<Index>(site);
  std::vector<LonLat>& loop = pen.positions_;
  loop.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Index p = points[i];
    const Index q = points[i + 1 == points.size() ? 0 : i + 1];
    if (p >= triangulation_.num_faces() || representative(p) != p) return false;
    const Triple& face = triangulation_.faces()[p];
    const unsigned corner = topology::corner_of(face, a);
    const ArcTolerance tolerance = tolerance_between(own_direction, face[(corner + 2) % 3]);
    const MapPoint from{snapped(cells_.points[p]), positions_[p]};
    const MapPoint to{snapped(cells_.points[q]), positions_[q]};
    if (!is_surely_one_line(from, to, tolerance.least)) return false;
    loop.push_back(positions_[p]);
  }
  return is_plain_loop(loop) && !has_crossing_lines(loop);
}

ArcTolerance CellMap::tolerance_between(const Point& own_direction, std::size_t other) const {
  const Point& other_direction = directions_[other];
  const double most = std::max(tolerance_, merge_distance);
  const double least = distance(own_direction, other_direction) / 8;
  const Point middle = own_direction + other_direction;
  const double length = norm(middle);
  if (length == 0) return {most, most, {}};  // the sites are antipodes
  return {std::clamp(least, merge_distance, most), most, middle / length};
}

// In dimension 1 all arcs have the tolerance of the closest pair of sites.
void CellMap::prepare_great_circle() {
  const std::span<const Index> ring = triangulation_.ring();
  const Point first = directions_[ring.front()];
  circle_tolerance_ = tolerance_between(first, ring.back());
  double length = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const Point& own = directions_[ring[i]];
    circle_tolerance_.least =
        std::min(circle_tolerance_.least, tolerance_between(own, ring[i - 1]).least);
    const Point axis = cross(first, own);
    if (norm(axis) <= length) continue;
    length = norm(axis);
    axis_ = axis;
  }
}

// Returns the tolerance of an arc from a pole of the great circle to the middle of two neighbors,
// which is the center of the tolerance. If there are only two sites, their cells are hemispheres
// and the tolerance has no center.
ArcTolerance CellMap::great_circle_tolerance(Index from, Index to) const {
  ArcTolerance tolerance = circle_tolerance_;
  if (triangulation_.ring().size() == 2) return tolerance;
  const Point& p = cells_.points[std::min(from, to)];
  const Point& q = cells_.points[std::max(from, to)];
  tolerance.center = std::abs(dot(p, axis_)) < std::abs(dot(q, axis_)) ? p : q;
  return tolerance;
}

void CellMap::add_arc(Index from, Index to, const ArcTolerance& tolerance, Ring& ring) const {
  if (from == to) return;
  const Edge edge = std::minmax(from, to);
  const auto add = [&](const Point& point) {
    if (!ring.points.empty() && ring.points.back() == point) ring.points.pop_back();
    ring.points.push_back(point);
    ring.tolerances.resize(ring.points.size(), tolerance);
    ring.tolerances.back() = tolerance;
    ring.edges.resize(ring.points.size(), edge);
    ring.edges.back() = edge;
  };
  add(snapped(cells_.points[from]));
  const auto inner = inner_points_.empty() ? inner_points_.end() : inner_points_.find(edge);
  if (inner == inner_points_.end()) return;
  const std::vector<Point>& points = inner->second;
  if (from == edge.first) {
    std::for_each(points.begin(), points.end(), add);
  } else {
    std::for_each(points.rbegin(), points.rend(), add);
  }
}

// Draws the ring of a site's cell into `ring` and `trace`. Returns false if fewer than three points
// are left.
//
// In the ring of site a, the arc that follows face (a, u, v) lies between a and v; points of the
// diagram that are no circumcenters lie on such an arc.
bool CellMap::draw_ring(std::size_t site, Ring& ring, Trace& trace) const {
  const std::span<const Index> points = points_of(site);
  const Point& own_direction = directions_[site];
  const auto a = static_cast<Index>(site);
  ArcTolerance tolerance;
  const auto read_face = [&](Index point) {
    if (point >= triangulation_.num_faces()) return false;
    const Triple& face = triangulation_.faces()[point];
    const unsigned corner = topology::corner_of(face, a);
    tolerance = tolerance_between(own_direction, face[(corner + 2) % 3]);
    return true;
  };
  ring.points.clear();
  ring.tolerances.clear();
  ring.edges.clear();
  // Finds the face before the arc that closes the ring.
  static_cast<void>(std::find_if(points.rbegin(), points.rend(), read_face));
  for (std::size_t i = 0; i < points.size(); ++i) {
    read_face(points[i]);
    const Index from = representative(points[i]);
    const Index to = representative(points[(i + 1) % points.size()]);
    add_arc(from, to,
            triangulation_.dimension() == 2 ? tolerance : great_circle_tolerance(from, to), ring);
  }
  if (ring.points.size() > 1 && ring.points.back() == ring.points.front()) {
    ring.points.pop_back();
  }
  if (ring.points.size() < 3) return false;
  draw(ring.points, ring.tolerances, trace);
  return true;
}

}  // namespace rondel::map
