// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "map/map_plane.h"

namespace rondel::map {
namespace {

// The sides of the rectangle's border, counterclockwise from its corner in the north west.
enum Side : std::size_t { left, bottom, right, top };
constexpr std::size_t num_sides = 4;

// The corner at the end of each side.
constexpr std::array<LonLat, num_sides> corners{{{-180, -90}, {180, -90}, {180, 90}, {-180, 90}}};

// An end of a chain: its place on the border, as a side and a distance along it.
struct Gate {
  Side side;
  double along;
  std::size_t chain;

  friend bool operator<(const Gate& a, const Gate& b) {
    return a.side != b.side ? a.side < b.side : a.along < b.along;
  }
};

Gate gate_at(const MapPoint& end, std::size_t chain) {
  const auto [lon, lat] = end.position;
  if (is_pole(end.point)) {
    return lat > 0 ? Gate{top, -lon, chain} : Gate{bottom, lon, chain};
  }
  return lon > 0 ? Gate{right, lat, chain} : Gate{left, -lat, chain};
}

// Returns twice the area of a ring in square degrees, positive if it is counterclockwise.
double doubled_area(std::span<const LonLat> ring) {
  double area = 0;
  const LonLat origin = ring.front();
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    area += (ring[i].lon_deg - origin.lon_deg) * (ring[i + 1].lat_deg - origin.lat_deg) -
            (ring[i + 1].lon_deg - origin.lon_deg) * (ring[i].lat_deg - origin.lat_deg);
  }
  return area;
}

// True if a position occurs twice. A few positions are compared faster than they are copied and
// sorted.
bool visits_twice(std::span<const LonLat> positions) {
  if (positions.size() <= longest_plain) {
    for (std::size_t i = 1; i < positions.size(); ++i) {
      const auto earlier = positions.first(i);
      if (std::find(earlier.begin(), earlier.end(), positions[i]) != earlier.end()) return true;
    }
    return false;
  }
  std::vector<LonLat> ring(positions.begin(), positions.end());
  std::sort(ring.begin(), ring.end(), InPlane());
  return std::adjacent_find(ring.begin(), ring.end()) != ring.end();
}

// Twice the area, in square degrees, of a sliver as wide as rounding from one end of the map to the
// other. The exact value does not matter: what is turned over and no wider than a few times that is
// dropped or settled.
constexpr double area_of_rounding = 2 * 360 * merge_distance * degrees_per_radian;

struct Loops {
  std::vector<LonLatPolygon> polygons;
  bool is_turned_over = false;  // true if a loop is clockwise and wider than rounding
};

// Appends a simple loop as a polygon. A loop without area is a line along the antimeridian and is
// dropped. A clockwise loop is narrower than its lines resolve: it is dropped if it is a part of a
// ring, and reversed otherwise.
void append_simple_loop(std::vector<LonLat> ring, bool is_part, Loops& out) {
  if (ring.size() < 3) return;
  const double area = doubled_area(ring);
  out.is_turned_over = out.is_turned_over || area < -area_of_rounding;
  if (area == 0 || (area < 0 && is_part)) return;
  if (area < 0) std::reverse(ring.begin(), ring.end());
  ring.push_back(ring.front());
  out.polygons.push_back({std::move(ring)});
}

// Splits a ring that visits positions several times into simple loops, and appends them.
void append_loops_of(const std::vector<LonLat>& ring, Loops& out) {
  std::map<LonLat, std::size_t, InPlane> places;
  std::vector<LonLat> open;
  for (const LonLat& position : ring) {
    const auto [place, is_new] = places.try_emplace(position, open.size());
    if (!is_new) {
      const auto first = open.begin() + static_cast<std::ptrdiff_t>(place->second);
      append_simple_loop({first, open.end()}, true, out);
      std::for_each(first + 1, open.end(), [&](const LonLat& p) { places.erase(p); });
      open.erase(first + 1, open.end());
      continue;
    }
    open.push_back(position);
  }
  append_simple_loop(std::move(open), true, out);
}

// Appends a loop as polygons, without repeated positions and without sides that go back on
// themselves.
void append_loop(const std::vector<LonLat>& loop, Loops& out) {
  std::vector<LonLat> ring;
  for (const LonLat& position : loop) {
    if (!ring.empty() && ring.back() == position) continue;
    if (ring.size() >= 2 && ring[ring.size() - 2] == position) {
      ring.pop_back();
      continue;
    }
    ring.push_back(position);
  }
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  if (visits_twice(ring)) {
    append_loops_of(ring, out);
  } else {
    append_simple_loop(std::move(ring), false, out);
  }
}

// A convex region contains no pair of antipodes, and antipodal regions have the same area in the
// plane, so it covers at most half of the rectangle. Polygons that cover nearly all of it are the
// outside of a region no wider than rounding.
constexpr double max_per_rectangle = 1.5 * 360 * 180;  // twice the area, square degrees

bool is_outside(const std::vector<LonLatPolygon>& polygons) {
  double doubled = 0;
  for (const LonLatPolygon& polygon : polygons) doubled += doubled_area(polygon.ring);
  return doubled > max_per_rectangle;
}

// Joins chains along the border into loops. With the region to the left, the border belongs to the
// region counterclockwise from the end of a chain to the next start. So in that order the k-th end
// leads to the k-th start, or to the start after it if the region has the corner in the north west
// inside. Ends and starts are sorted separately: if rounding has exchanged a neighboring end and
// start, the effect stays between them.
class Stitching {
 public:
  explicit Stitching(const Trace& trace) : trace_(trace), next_(trace.starts.size()) {
    const std::size_t n = trace.starts.size();
    std::vector<Gate> starts;
    std::vector<Gate> ends;
    for (std::size_t chain = 0; chain < n; ++chain) {
      starts.push_back(gate_at(trace.points[trace.starts[chain]], chain));
      ends.push_back(gate_at(trace.points[past(chain) - 1], chain));
    }
    std::stable_sort(starts.begin(), starts.end());
    std::stable_sort(ends.begin(), ends.end());
    for (std::size_t k = 0; k < n; ++k) {
      const bool wraps = trace.has_north_corners && k + 1 == n;
      const Gate& start = starts[trace.has_north_corners ? (k + 1) % n : k];
      next_[ends[k].chain] = {start.chain, ends[k].side, start.side + (wraps ? num_sides : 0)};
    }
  }

  void append_loops(std::vector<std::vector<LonLat>>& out) const {
    std::vector<bool> is_used(next_.size(), false);
    for (std::size_t first = 0; first < next_.size(); ++first) {
      if (is_used[first]) continue;
      std::vector<LonLat> loop;
      for (std::size_t chain = first; !is_used[chain]; chain = next_[chain].chain) {
        is_used[chain] = true;
        for (std::size_t i = trace_.starts[chain]; i < past(chain); ++i) {
          loop.push_back(trace_.points[i].position);
        }
        for (std::size_t side = next_[chain].first_side; side < next_[chain].last_side; ++side) {
          loop.push_back(corners[side % num_sides]);
        }
      }
      out.push_back(std::move(loop));
    }
  }

 private:
  // The chain that follows a chain, and the range of sides at whose ends the border turns on the
  // way.
  struct NextChain {
    std::size_t chain = 0;
    std::size_t first_side = 0;
    std::size_t last_side = 0;
  };

  [[nodiscard]] std::size_t past(std::size_t chain) const {
    return chain + 1 < trace_.starts.size() ? trace_.starts[chain + 1] : trace_.points.size();
  }

  const Trace& trace_;
  std::vector<NextChain> next_;
};

std::vector<std::vector<LonLat>> loops_of_chains(const Trace& trace) {
  std::vector<std::vector<LonLat>> loops;
  if (!trace.starts.empty()) {
    Stitching(trace).append_loops(loops);
    return loops;
  }
  std::vector<LonLat>& loop = loops.emplace_back();
  for (const MapPoint& point : trace.points) loop.push_back(point.position);
  return loops;
}

Loops loops_of(const Trace& trace) {
  Loops loops;
  for (const std::vector<LonLat>& loop : loops_of_chains(trace)) append_loop(loop, loops);
  if (trace.starts.empty() || !is_outside(loops.polygons)) return loops;
  return {.polygons = {}, .is_turned_over = true};
}

// Draws a ring of snapped points. Returns false if fewer than three distinct points are left.
bool draw_snapped(std::span<const Point> ring, std::span<const double> tolerances_deg,
                  Trace& trace) {
  std::vector<Point> points;
  std::vector<ArcTolerance> tolerances;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point point = snapped(ring[i]);
    if (point == snapped(ring[(i + 1) % ring.size()])) continue;
    points.push_back(point);
    const double tolerance = tolerances_deg[i] / degrees_per_radian;
    tolerances.push_back({tolerance, tolerance, {}});
  }
  if (points.size() < 3) return false;
  draw(points, tolerances, trace);
  return true;
}

}  // namespace

bool is_plain_loop(std::span<const LonLat> loop) {
  return loop.size() >= 3 && loop.size() <= longest_plain && !visits_twice(loop) &&
         !has_spike(loop) && is_counterclockwise(loop);
}

std::vector<std::vector<LonLat>> drawn_loops(const Trace& trace) {
  std::vector<std::vector<LonLat>> loops = loops_of_chains(trace);
  double doubled = 0;
  for (const std::vector<LonLat>& loop : loops) doubled += doubled_area(loop);
  if (doubled > max_per_rectangle) loops.emplace_back(corners.rbegin(), corners.rend());
  return loops;
}

std::vector<LonLatPolygon> polygons_of(const Trace& trace) { return loops_of(trace).polygons; }

bool is_turned_over(const Trace& trace) { return loops_of(trace).is_turned_over; }

std::vector<LonLatPolygon> lonlat_polygons(std::span<const Point> ring,
                                           std::span<const double> tolerances_deg) {
  if (ring.empty()) {
    return {{{corners[0], corners[1], corners[2], corners[3], corners[0]}}};
  }
  Trace trace;
  if (!draw_snapped(ring, tolerances_deg, trace)) return {};
  return polygons_of(trace);
}

std::vector<std::vector<LonLat>> lonlat_loops(std::span<const Point> ring,
                                              std::span<const double> tolerances_deg) {
  if (ring.empty()) return {{corners.begin(), corners.end()}};
  Trace trace;
  if (!draw_snapped(ring, tolerances_deg, trace)) return {};
  return drawn_loops(trace);
}

}  // namespace rondel::map
