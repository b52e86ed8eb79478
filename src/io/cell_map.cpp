// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/cell_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/crossing_lines.h"

namespace rondel::io {
namespace {

// An arc of this length (radians) is straight up to rounding wherever tips can be told apart.
constexpr double shortest_bisected = 0x1p-24;
// Bisecting an arc of 120 degrees this often makes it as short as that.
constexpr int max_passes = 26;

double distance(const Point& p, const Point& q) { return norm(difference(p, q)); }

double largest_coordinate(const Point& p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

}  // namespace

CellMap::CellMap(std::span<const Point> sites, const Triangulation& triangulation,
                 const Cells& cells, double tolerance_deg, const Progress& progress)
    : sites_(sites),
      triangulation_(triangulation),
      cells_(cells),
      tolerance_(tolerance_deg / degrees_per_radian),
      least_tolerance_(triangulation.dimension() < 2 ? least_tolerance() : 0),
      only_vertex_(triangulation.dimension() == 0 ? triangulation.ring().front() : sites.size()),
      representatives_(cells.points.size()) {
  merge_close_points();
  bisect_crossing_lines(progress);
}

bool CellMap::has_cell(std::size_t site) const {
  return site == only_vertex_ || !points_of(site).empty();
}

std::vector<LonLatPolygon> CellMap::polygons(std::size_t site) {
  if (site == only_vertex_) return lonlat_polygons({}, tolerance_);
  if (!draw_ring(site)) return {};
  return polygons_of(trace_);
}

std::span<const Index> CellMap::points_of(std::size_t site) const {
  const std::uint64_t first = cells_.offsets[site];
  return std::span(cells_.rings).subspan(first, cells_.offsets[site + 1] - first);
}

Index CellMap::representative(Index point) {
  while (representatives_[point] != point) {
    representatives_[point] = representatives_[representatives_[point]];
    point = representatives_[point];
  }
  return point;
}

void CellMap::merge_close_points() {
  std::iota(representatives_.begin(), representatives_.end(), Index{0});
  for (std::size_t site = 0; site < sites_.size(); ++site) {
    const std::span<const Index> ring = points_of(site);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Index p = ring[i];
      const Index q = ring[i + 1 == ring.size() ? 0 : i + 1];
      if (distance(cells_.points[p], cells_.points[q]) > merge_distance) continue;
      const auto [low, high] = std::minmax({representative(p), representative(q)});
      representatives_[high] = low;
    }
  }
  for (Index& point : representatives_) point = representative(point);
}

// Scaled first, so that the largest and smallest doubles are normalized too.
Point CellMap::direction(std::size_t site) const {
  const Point p = difference(sites_[site], triangulation_.sphere().center);
  const double scale = largest_coordinate(p);
  return scale > 0 ? normalized({p.x / scale, p.y / scale, p.z / scale}) : p;
}

double CellMap::arc_tolerance(const Point& own_direction, std::size_t other) const {
  return std::clamp(distance(own_direction, direction(other)) / 8, merge_distance,
                    std::max(tolerance_, merge_distance));
}

double CellMap::least_tolerance() const {
  const std::span<const Index> ring = triangulation_.ring();
  double least = tolerance_;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    least = std::min(least, arc_tolerance(direction(ring[i]), ring[(i + 1) % ring.size()]));
  }
  return std::max(least, merge_distance);
}

void CellMap::add_arc(Index from, Index to, double tolerance) {
  if (from == to) return;
  const Edge edge = std::minmax(from, to);
  const auto add = [&](const Point& point) {
    if (!ring_.points.empty() && ring_.points.back() == point) ring_.points.pop_back();
    ring_.points.push_back(point);
    ring_.tolerances.resize(ring_.points.size(), tolerance);
    ring_.tolerances.back() = tolerance;
    ring_.edges.resize(ring_.points.size(), edge);
    ring_.edges.back() = edge;
  };
  add(snapped(cells_.points[from]));
  const auto inner = bisected_.empty() ? bisected_.end() : bisected_.find(edge);
  if (inner == bisected_.end()) return;
  const std::vector<Point>& points = inner->second;
  if (from == edge.first) {
    std::for_each(points.begin(), points.end(), add);
  } else {
    std::for_each(points.rbegin(), points.rend(), add);
  }
}

// Fills ring_ and trace_; false if fewer than three points are left.
//
// In the ring of site a the arc that follows face (a, u, v) lies between a and v; positions beyond
// the faces are points on such an arc.
bool CellMap::draw_ring(std::size_t site) {
  const std::span<const Index> ring = points_of(site);
  const Point own_direction = direction(site);
  const auto a = static_cast<Index>(site);
  double tolerance = least_tolerance_;
  const auto read_face = [&](Index point) {
    if (point >= triangulation_.num_faces()) return false;
    const Triple& face = triangulation_.faces()[point];
    const std::size_t corner = face[0] == a ? 0 : (face[1] == a ? 1 : 2);
    tolerance = arc_tolerance(own_direction, face[(corner + 2) % 3]);
    return true;
  };
  ring_.points.clear();
  ring_.tolerances.clear();
  ring_.edges.clear();
  std::find_if(ring.rbegin(), ring.rend(), read_face);  // the arc at the seam of the ring
  for (std::size_t i = 0; i < ring.size(); ++i) {
    read_face(ring[i]);
    add_arc(representatives_[ring[i]], representatives_[ring[(i + 1) % ring.size()]], tolerance);
  }
  if (ring_.points.size() > 1 && ring_.points.back() == ring_.points.front()) {
    ring_.points.pop_back();
  }
  if (ring_.points.size() < 3) return false;
  draw(ring_.points, ring_.tolerances, trace_);
  return true;
}

void CellMap::bisect_crossing_lines(const Progress& progress) {
  bool has_changed = false;
  for (std::size_t site = 0; site < sites_.size(); ++site) {
    has_changed |= bisect_crossing_lines(site);
    if (progress && site % 4096 == 0) {
      progress("outline", static_cast<double>(site) / static_cast<double>(sites_.size()));
    }
  }
  for (int pass = 0; has_changed && pass < max_passes; ++pass) {
    has_changed = false;
    for (std::size_t site = 0; site < sites_.size(); ++site) {
      if (meets_bisected_arc(site)) has_changed |= bisect_crossing_lines(site);
    }
  }
}

bool CellMap::meets_bisected_arc(std::size_t site) const {
  const std::span<const Index> ring = points_of(site);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Index p = representatives_[ring[i]];
    const Index q = representatives_[ring[(i + 1) % ring.size()]];
    if (bisected_.contains(std::minmax(p, q))) return true;
  }
  return false;
}

bool CellMap::bisect_crossing_lines(std::size_t site) {
  if (!draw_ring(site)) return false;
  const std::vector<std::size_t> lines = crossing_lines(trace_);
  std::vector<Edge> edges;
  for (const std::size_t line : lines) edges.push_back(ring_.edges[trace_.arcs[line]]);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  bool has_changed = false;
  for (const Edge& edge : edges) has_changed |= bisect(edge, lines);
  return has_changed;
}

// Keeps the points of the edge as they are drawn, with the midpoints of those of its lines that are
// not too short; false if all are.
bool CellMap::bisect(const Edge& edge, std::span<const std::size_t> lines) {
  const auto is_on_edge = [&](std::size_t i) { return ring_.edges[trace_.arcs[i]] == edge; };
  const Point low = snapped(cells_.points[edge.first]);
  const Point high = snapped(cells_.points[edge.second]);
  std::vector<Point> points;
  for (const std::size_t line : lines) {
    if (!is_on_edge(line)) continue;
    const Point& p = trace_.points[line].point;
    const Point& q = trace_.points[(line + 1) % trace_.points.size()].point;
    if (distance(p, q) > shortest_bisected) points.push_back(normalized(sum(p, q)));
  }
  if (points.empty()) return false;
  for (std::size_t i = 0; i < trace_.points.size(); ++i) {
    const Point& p = trace_.points[i].point;
    if (is_on_edge(i) && p != low && p != high) points.push_back(p);
  }
  const auto key = [&](const Point& p) { return distance(low, p); };
  std::sort(points.begin(), points.end(),
            [&](const Point& p, const Point& q) { return key(p) < key(q); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  bisected_[edge] = std::move(points);
  return true;
}

}  // namespace rondel::io
