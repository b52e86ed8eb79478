// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/cell_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <tuple>

#include "io/crossing_lines.h"
#include "system/parallel.h"

namespace rondel::io {
namespace {

// In radians. At a tip whole arcs of the diagram are no longer than the rounding of a distant
// circumcenter: ends of arcs up to 6 mm on the earth merge.
constexpr double longest_merged = 0x1p-30;
// Each pass carries points across one more cell of a row of narrow ones.
constexpr int max_passes = 46;

bool is_before(const Point& p, const Point& q) {
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

double distance(const Point& p, const Point& q) { return norm(difference(p, q)); }

double largest_coordinate(const Point& p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

}  // namespace

CellMap::CellMap(std::span<const Point> sites, const Triangulation& triangulation,
                 const Cells& cells, double tolerance_deg, unsigned threads,
                 const Progress& progress)
    : sites_(sites),
      triangulation_(triangulation),
      cells_(cells),
      tolerance_(tolerance_deg / degrees_per_radian),
      only_vertex_(triangulation.dimension() == 0 ? triangulation.ring().front() : sites.size()),
      representatives_(cells.points.size()) {
  if (triangulation.dimension() == 1) prepare_great_circle();
  merge_close_points();
  resolve_crossing_lines(threads, progress);
}

bool CellMap::has_cell(std::size_t site) const {
  return site == only_vertex_ || !points_of(site).empty();
}

std::vector<LonLatPolygon> CellMap::polygons(std::size_t site, Pen& pen) const {
  if (site == only_vertex_) return lonlat_polygons({}, tolerance_);
  if (unresolved_.contains(site) || !draw_ring(site, pen.ring_, pen.trace_)) return {};
  return polygons_of(pen.trace_);
}

std::span<const Index> CellMap::points_of(std::size_t site) const {
  const std::uint64_t first = cells_.offsets[site];
  return std::span(cells_.rings).subspan(first, cells_.offsets[site + 1] - first);
}

Index CellMap::representative(Index point) const {
  while (representatives_[point] != point) point = representatives_[point];
  return point;
}

// Shortens the way for the next time.
Index CellMap::find_representative(Index point) {
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
      const auto [low, high] = std::minmax({find_representative(p), find_representative(q)});
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

// Fills `ring` and `trace`; false if fewer than three points are left.
//
// In the ring of site a the arc that follows face (a, u, v) lies between a and v; positions beyond
// the faces are points on such an arc.
bool CellMap::draw_ring(std::size_t site, Ring& ring, Trace& trace) const {
  const std::span<const Index> points = points_of(site);
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
  ring.points.clear();
  ring.tolerances.clear();
  ring.edges.clear();
  // The arc at the seam of the ring.
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

// The cells whose lines cross, in increasing order.
std::vector<std::size_t> CellMap::find_crossing_lines(unsigned threads,
                                                      const Progress& progress) const {
  constexpr std::size_t grain = 1024;
  constexpr std::size_t stretch = 64 * grain;  // between two reports
  const std::size_t num_sites = sites_.size();
  std::vector<std::vector<std::size_t>> found(system::num_pieces(num_sites, grain));
  for (std::size_t first = 0; first < num_sites; first += stretch) {
    if (progress) {
      progress("outline", static_cast<double>(first) / static_cast<double>(num_sites));
    }
    const std::size_t size = std::min(stretch, num_sites - first);
    system::parallel_for(threads, size, grain, [&](std::size_t begin, std::size_t end) {
      Pen pen;
      for (std::size_t site = first + begin; site < first + end; ++site) {
        if (draw_ring(site, pen.ring_, pen.trace_) && !crossing_lines(pen.trace_).empty()) {
          found[site / grain].push_back(site);
        }
      }
    });
  }
  std::vector<std::size_t> sites;
  for (const auto& some : found) sites.insert(sites.end(), some.begin(), some.end());
  return sites;
}

// What a cell's lines do depends on its points and their representatives alone. So the first pass
// needs to look again only at cells whose lines crossed, and at those changed since by others: the
// result is that of one pass over all cells in order.
void CellMap::resolve_crossing_lines(unsigned threads, const Progress& progress) {
  const std::vector<std::size_t> crossed = find_crossing_lines(threads, progress);
  if (crossed.empty()) return;
  bool has_changed = false;
  auto next = crossed.begin();
  for (std::size_t site = *next; site < sites_.size(); ++site) {
    const bool has_crossed = next != crossed.end() && *next == site;
    if (has_crossed) ++next;
    if (has_crossed || has_changed_arc(site)) has_changed |= resolve_crossing_lines(site);
  }
  for (int pass = 0; has_changed && pass < max_passes; ++pass) {
    has_changed = false;
    for (std::size_t site = 0; site < sites_.size(); ++site) {
      if (has_changed_arc(site)) has_changed |= resolve_crossing_lines(site);
    }
  }
}

bool CellMap::has_changed_arc(std::size_t site) const {
  const std::span<const Index> ring = points_of(site);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Index p = representative(ring[i]);
    const Index q = representative(ring[(i + 1) % ring.size()]);
    if (merged_.contains(p) || inner_points_.contains(std::minmax(p, q))) return true;
  }
  return false;
}

bool CellMap::resolve_crossing_lines(std::size_t site) {
  unresolved_.erase(site);
  if (!draw_ring(site, ring_, trace_)) return false;
  const std::vector<LinePair> pairs = crossing_lines(trace_);
  if (pairs.empty()) return false;
  unresolved_.insert(site);
  std::set<Index> ends;
  for (const auto& [i, j] : pairs) {
    for (const Edge& edge : {edge_of(i), edge_of(j)}) ends.insert({edge.first, edge.second});
  }
  bool has_changed = false;
  for (std::size_t i = 0; i < ring_.points.size(); ++i) {
    const auto [low, high] = ring_.edges[i];
    if (!ends.contains(low) && !ends.contains(high)) continue;
    has_changed |= merge(ring_.edges[i], ring_.tolerances[i]);
  }
  return has_changed || align(pairs);
}

const CellMap::Edge& CellMap::edge_of(std::size_t line) const {
  return ring_.edges[trace_.arcs[line]];
}

bool CellMap::is_end(const Edge& edge, const Point& p) const {
  return p == snapped(cells_.points[edge.first]) || p == snapped(cells_.points[edge.second]);
}

// Gives each of two lines that cross the points opposite the ends of the other; false if all lines
// have them.
bool CellMap::align(std::span<const LinePair> pairs) {
  std::map<Edge, Inner> drawn;
  for (const auto& [i, j] : pairs) drawn[edge_of(i)], drawn[edge_of(j)];
  for (std::size_t i = 0; i < trace_.points.size(); ++i) {
    const auto inner = drawn.find(edge_of(i));
    const Point& p = trace_.points[i].point;
    if (inner != drawn.end() && !is_end(inner->first, p)) inner->second.kept.push_back(p);
  }
  bool has_changed = false;
  for (const auto& [i, j] : pairs) {
    if (edge_of(i) == edge_of(j)) continue;
    for (const auto& [line, other] : {LinePair{i, j}, LinePair{j, i}}) {
      has_changed |= align(line, edge_of(other), trace_.points[other].point, drawn);
      has_changed |= align(line, edge_of(other), line_end(other), drawn);
    }
  }
  if (!has_changed) return false;
  for (auto& [edge, inner] : drawn) keep(edge, inner);
  return true;
}

const Point& CellMap::line_end(std::size_t line) const {
  return trace_.points[(line + 1) % trace_.points.size()].point;
}

// Gives a line the point opposite `p` of another edge. Points within merge_distance become one: of
// two vertices of the diagram that of the lower index, else a vertex or the first in
// lexicographic order, so that points do not change to and fro.
bool CellMap::align(std::size_t line, const Edge& other, const Point& p,
                    std::map<Edge, Inner>& drawn) {
  const Edge& edge = edge_of(line);
  const Point& from = trace_.points[line].point;
  const Point& to = line_end(line);
  if (p == from || p == to) return false;
  for (const Point& end : {from, to}) {
    if (distance(p, end) > merge_distance) continue;
    if (is_end(edge, end)) return is_end(other, p) && merge_vertices(edge, end, other, p);
    if (!is_end(other, p) && !is_before(p, end)) return false;
    drawn[edge].dropped.push_back(end);
    drawn[edge].kept.push_back(p);
    return true;
  }
  const std::optional<Point> foot = foot_on_arc(p, from, to);
  if (!foot) return false;
  const Point point = distance(*foot, p) <= merge_distance ? p : snapped(*foot);
  if (is_pole(point) || distance(point, from) <= merge_distance ||
      distance(point, to) <= merge_distance)
    return false;
  drawn[edge].kept.push_back(point);
  return true;
}

bool CellMap::merge_vertices(const Edge& edge, const Point& p, const Edge& other, const Point& q) {
  const auto vertex = [&](const Edge& e, const Point& point) {
    return representative(point == snapped(cells_.points[e.first]) ? e.first : e.second);
  };
  const auto [low, high] = std::minmax({vertex(edge, p), vertex(other, q)});
  if (low == high) return false;
  representatives_[high] = low;
  merged_.insert(low);
  return true;
}

void CellMap::keep(const Edge& edge, Inner& inner) {
  std::sort(inner.kept.begin(), inner.kept.end(), is_before);
  std::sort(inner.dropped.begin(), inner.dropped.end(), is_before);
  std::vector<Point>& points = inner_points_[edge];
  points.clear();
  std::set_difference(inner.kept.begin(), inner.kept.end(), inner.dropped.begin(),
                      inner.dropped.end(), std::back_inserter(points), is_before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  const Point low = snapped(cells_.points[edge.first]);
  const auto key = [&](const Point& p) { return distance(low, p); };
  std::sort(points.begin(), points.end(),
            [&](const Point& p, const Point& q) { return key(p) < key(q); });
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
