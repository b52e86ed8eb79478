// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Resolves cells whose lines cross although their arcs do not: items 3 and 4 of CellMap.
#include <algorithm>
#include <iterator>
#include <optional>
#include <tuple>

#include "map/cell_map.h"
#include "map/trace.h"
#include "system/job.h"
#include "system/parallel.h"

namespace rondel::map {
namespace {

// The longest arc, in radians, whose ends may merge: 6 mm on the earth. At a tip whole arcs of the
// diagram may be no longer than the rounding of a distant circumcenter.
constexpr double longest_merged = 0x1p-30;
// Lines of cells of circles are bisected until they are this short (radians). A line of length
// short_line is within 2^-23 of its arc away from the poles. Where aligned points do not help,
// lines are bisected down to shortest_line.
constexpr double short_line = 0x1p-10;
constexpr double shortest_line = 0x1p-20;
// A ring with more lines is not bisected, so that a narrow cell cannot fill a file.
constexpr std::size_t max_lines = 4096;
// Each pass carries points across one more cell in a row of narrow cells, and may add as many
// points as the pass before. This bounds time and size where rows are longer; docs/theory/map.md
// has measurements.
constexpr int max_passes = 46;

bool is_before(const Point& p, const Point& q) {
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

}  // namespace

// Returns the pairs of lines that cross. For the cell of a circle that is turned over, it returns
// each line, paired with itself.
std::vector<CellMap::LinePair> CellMap::crossed_lines(const Trace& trace) const {
  std::vector<LinePair> pairs = crossing_lines(trace);
  const bool is_certain = !pairs.empty() || triangulation_.model() != Model::weighted;
  if (is_certain || !is_turned_over(trace)) return pairs;
  for (std::size_t i = 0; i < trace.points.size(); ++i) pairs.emplace_back(i, i);
  return pairs;
}

// Returns the sites of the cells whose lines cross, in increasing order, and determines which cells
// are plain on the way.
std::vector<std::size_t> CellMap::find_crossing_lines(const Execution& execution) {
  constexpr std::size_t grain = 1024;
  constexpr std::size_t stretch = 64 * grain;  // between two reports
  const std::size_t num_cells = cells_in_order_.size();
  std::vector<std::vector<std::size_t>> found(system::num_pieces(num_cells, grain));
  for (std::size_t first = 0; first < num_cells; first += stretch) {
    system::announce(execution, "outline", first, num_cells);
    const std::size_t size = std::min(stretch, num_cells - first);
    system::parallel_for(execution.threads, size, grain, [&](std::size_t begin, std::size_t end) {
      Pen pen;
      for (std::size_t cell = first + begin; cell < first + end; ++cell) {
        prefetch_listed(cell);
        const Index site = cells_in_order_[cell];
        if (find_plain(site, pen)) {
          is_plain_[site] = 1;
        } else if (draw_ring(site, pen.ring_, pen.trace_) && !crossed_lines(pen.trace_).empty()) {
          found[cell / grain].push_back(site);
        }
      }
    });
  }
  std::vector<std::size_t> sites;
  for (const auto& some : found) sites.insert(sites.end(), some.begin(), some.end());
  std::ranges::sort(sites);
  return sites;
}

// The lines of a cell depend only on its points and their representatives. So after the first pass
// only the cells whose lines crossed and those that others have changed since have to be tested
// again; the result is that of a pass over all cells in order. As long as nothing has changed, no
// cell has a changed arc, and a pass does nothing.
void CellMap::resolve_crossing_lines(const Execution& execution) {
  const std::vector<std::size_t> crossed = find_crossing_lines(execution);
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
  const std::vector<LinePair> pairs = crossed_lines(trace_);
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
  return has_changed || bisect(pairs, short_line) || align(pairs) || bisect(pairs, shortest_line);
}

const CellMap::Edge& CellMap::edge_of(std::size_t line) const {
  return ring_.edges[trace_.arcs[line]];
}

bool CellMap::is_end(const Edge& edge, const Point& p) const {
  return p == snapped(cells_.points[edge.first]) || p == snapped(cells_.points[edge.second]);
}

// Returns the drawn points, without ends, of each edge on which one of the lines lies.
std::map<CellMap::Edge, CellMap::Inner> CellMap::drawn_points(
    std::span<const LinePair> pairs) const {
  std::map<Edge, Inner> drawn;
  for (const auto& [i, j] : pairs) drawn[edge_of(i)], drawn[edge_of(j)];
  for (std::size_t i = 0; i < trace_.points.size(); ++i) {
    const auto inner = drawn.find(edge_of(i));
    const Point& p = trace_.points[i].point;
    if (inner != drawn.end() && !is_end(inner->first, p)) inner->second.kept.push_back(p);
  }
  return drawn;
}

// Bisects the lines of these pairs that are longer than `shortest` (radians). Returns false if all
// are shorter, or if the ring has more than max_lines.
bool CellMap::bisect(std::span<const LinePair> pairs, double shortest) {
  if (triangulation_.model() != Model::weighted || trace_.points.size() > max_lines) return false;
  std::map<Edge, Inner> drawn = drawn_points(pairs);
  bool has_changed = false;
  for (const auto& [i, j] : pairs) {
    for (const std::size_t line : {i, j}) {
      const Point& from = trace_.points[line].point;
      const Point& to = line_end(line);
      // A line to a pole follows a meridian, as its arc does.
      if (distance(from, to) <= shortest || is_pole(from) || is_pole(to)) continue;
      const Point middle = snapped(normalized(from + to));
      if (middle == from || middle == to || is_pole(middle)) continue;
      drawn[edge_of(line)].kept.push_back(middle);
      has_changed = true;
    }
  }
  if (has_changed) keep(drawn);
  return has_changed;
}

// Gives each line of a crossing pair the points opposite the ends of the other line. Returns false
// if all lines have such points already.
bool CellMap::align(std::span<const LinePair> pairs) {
  std::map<Edge, Inner> drawn = drawn_points(pairs);
  bool has_changed = false;
  for (const auto& [i, j] : pairs) {
    if (edge_of(i) == edge_of(j)) continue;
    for (const auto& [line, other] : {LinePair{i, j}, LinePair{j, i}}) {
      has_changed |= align(line, edge_of(other), trace_.points[other].point, drawn);
      has_changed |= align(line, edge_of(other), line_end(other), drawn);
    }
  }
  if (has_changed) keep(drawn);
  return has_changed;
}

const Point& CellMap::line_end(std::size_t line) const {
  return trace_.points[(line + 1) % trace_.points.size()].point;
}

// Gives a line the point opposite `p`, a point of another edge. Points within merge_distance are
// merged: two vertices of the diagram into the one with the lower index, and otherwise into a
// vertex or the lexicographically first point, so that passes do not undo each other.
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

void CellMap::keep(std::map<Edge, Inner>& drawn) {
  for (auto& [edge, inner] : drawn) {
    std::ranges::sort(inner.kept, is_before);
    std::ranges::sort(inner.dropped, is_before);
    std::vector<Point>& points = inner_points_[edge];
    points.clear();
    std::ranges::set_difference(inner.kept, inner.dropped, std::back_inserter(points), is_before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const Point low = snapped(cells_.points[edge.first]);
    std::ranges::sort(points, {}, [&](const Point& p) { return distance(low, p); });
  }
}

// Shrinks a very short arc at a tip to a point, if that moves the boundary much less than the sites
// are apart: by at most a part of the tolerance, a sixteenth, whose exact value does not matter.
// Rounding may have reversed such an arc, and then the sides of the tip cross.
bool CellMap::merge(const Edge& edge, const ArcTolerance& tolerance) {
  const auto [low, high] = std::minmax({representative(edge.first), representative(edge.second)});
  const double length = distance(cells_.points[low], cells_.points[high]);
  if (low == high || length > std::min(longest_merged, tolerance.least / 16)) return false;
  representatives_[high] = low;
  merged_.insert(low);
  return true;
}

}  // namespace rondel::map
