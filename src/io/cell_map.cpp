// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/cell_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/crossing_lines.h"

namespace rondel::io {
namespace {

// In radians. Lines are bisected until points would merge. At a tip whole arcs of the diagram are
// no longer than the rounding of a distant circumcenter: ends of arcs up to 6 mm on the earth
// merge.
constexpr double shortest_bisected = 4 * merge_distance;
constexpr double longest_merged = 0x1p-30;
// Bisecting an arc of 120 degrees this often makes it as short as that.
constexpr int max_passes = 46;

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
      only_vertex_(triangulation.dimension() == 0 ? triangulation.ring().front() : sites.size()),
      representatives_(cells.points.size()) {
  if (triangulation.dimension() == 1) prepare_great_circle();
  merge_close_points();
  resolve_crossing_lines(progress);
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
}

// Scaled first, so that the largest and smallest doubles are normalized too.
Point CellMap::direction(std::size_t site) const {
  const Point p = difference(sites_[site], triangulation_.sphere().center);
  const double scale = largest_coordinate(p);
  return scale > 0 ? normalized({p.x / scale, p.y / scale, p.z / scale}) : p;
}

ArcTolerance CellMap::tolerance_between(const Point& own_direction, std::size_t other) const {
  const Point other_direction = direction(other);
  const double most = std::max(tolerance_, merge_distance);
  const double least = distance(own_direction, other_direction) / 8;
  const Point middle = sum(own_direction, other_direction);
  const double length = norm(middle);
  if (length == 0) return {most, most, {}};  // antipodal
  return {std::clamp(least, merge_distance, most),
          most,
          {middle.x / length, middle.y / length, middle.z / length}};
}

// In dimension 1 one least tolerance, that of the closest sites, serves all arcs.
void CellMap::prepare_great_circle() {
  const std::span<const Index> ring = triangulation_.ring();
  const Point first = direction(ring.front());
  circle_tolerance_ = tolerance_between(first, ring.back());
  double length = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const Point own = direction(ring[i]);
    circle_tolerance_.least =
        std::min(circle_tolerance_.least, tolerance_between(own, ring[i - 1]).least);
    const Point axis = cross(first, own);
    if (norm(axis) <= length) continue;
    length = norm(axis);
    axis_ = axis;
  }
}

// An arc runs between the axis and a point between two sites; but around the middle of
// two sites there are two hemispheres.
ArcTolerance CellMap::great_circle_tolerance(Index from, Index to) const {
  ArcTolerance tolerance = circle_tolerance_;
  if (triangulation_.ring().size() == 2) return tolerance;
  const Point& p = cells_.points[std::min(from, to)];
  const Point& q = cells_.points[std::max(from, to)];
  tolerance.center = std::abs(dot(p, axis_)) < std::abs(dot(q, axis_)) ? p : q;
  return tolerance;
}

void CellMap::add_arc(Index from, Index to, const ArcTolerance& tolerance) {
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
  ArcTolerance tolerance;
  const auto read_face = [&](Index point) {
    if (point >= triangulation_.num_faces()) return false;
    const Triple& face = triangulation_.faces()[point];
    const std::size_t corner = face[0] == a ? 0 : (face[1] == a ? 1 : 2);
    tolerance = tolerance_between(own_direction, face[(corner + 2) % 3]);
    return true;
  };
  ring_.points.clear();
  ring_.tolerances.clear();
  ring_.edges.clear();
  // The arc at the seam of the ring.
  static_cast<void>(std::find_if(ring.rbegin(), ring.rend(), read_face));
  for (std::size_t i = 0; i < ring.size(); ++i) {
    read_face(ring[i]);
    const Index from = representative(ring[i]);
    const Index to = representative(ring[(i + 1) % ring.size()]);
    add_arc(from, to,
            triangulation_.dimension() == 2 ? tolerance : great_circle_tolerance(from, to));
  }
  if (ring_.points.size() > 1 && ring_.points.back() == ring_.points.front()) {
    ring_.points.pop_back();
  }
  if (ring_.points.size() < 3) return false;
  draw(ring_.points, ring_.tolerances, trace_);
  return true;
}

void CellMap::resolve_crossing_lines(const Progress& progress) {
  bool has_changed = false;
  for (std::size_t site = 0; site < sites_.size(); ++site) {
    has_changed |= resolve_crossing_lines(site);
    if (progress && site % 4096 == 0) {
      progress("outline", static_cast<double>(site) / static_cast<double>(sites_.size()));
    }
  }
  for (int pass = 0; has_changed && pass < max_passes; ++pass) {
    has_changed = false;
    for (std::size_t site = 0; site < sites_.size(); ++site) {
      if (has_changed_arc(site)) has_changed |= resolve_crossing_lines(site);
    }
  }
}

bool CellMap::has_changed_arc(std::size_t site) {
  const std::span<const Index> ring = points_of(site);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Index p = representative(ring[i]);
    const Index q = representative(ring[(i + 1) % ring.size()]);
    if (merged_.contains(p) || bisected_.contains(std::minmax(p, q))) return true;
  }
  return false;
}

bool CellMap::resolve_crossing_lines(std::size_t site) {
  if (!draw_ring(site)) return false;
  const std::vector<std::size_t> lines = crossing_lines(trace_);
  if (lines.empty()) return false;
  std::set<Edge> edges;
  std::set<Index> ends;
  for (const std::size_t line : lines) {
    const Edge& edge = ring_.edges[trace_.arcs[line]];
    edges.insert(edge);
    ends.insert({edge.first, edge.second});
  }
  bool has_changed = false;
  for (std::size_t i = 0; i < ring_.points.size(); ++i) {
    const auto [low, high] = ring_.edges[i];
    if (!ends.contains(low) && !ends.contains(high)) continue;
    has_changed |= merge(ring_.edges[i], ring_.tolerances[i]);
  }
  if (has_changed) return true;
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

// Shrinks a very short arc at a tip, where that moves the boundary much less than the sites are
// apart: rounding may have turned it round, and then the sides of the tip do cross.
bool CellMap::merge(const Edge& edge, const ArcTolerance& tolerance) {
  const auto [low, high] = std::minmax({representative(edge.first), representative(edge.second)});
  const double length = distance(cells_.points[low], cells_.points[high]);
  if (low == high || length > std::min(longest_merged, tolerance.least / 16)) return false;
  representatives_[high] = low;
  merged_.insert(low);
  return true;
}

}  // namespace rondel::io
