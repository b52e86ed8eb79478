// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "map/planar_loops.h"
#include "map/ring_area.h"
#include "map/trace.h"

namespace rondel::map {
namespace {

// The border of the rectangle counterclockwise from its corner in the north west, as a distance along it.
constexpr std::array<LonLat, 4> border_corners{{{-180, -90}, {180, -90}, {180, 90}, {-180, 90}}};
constexpr std::array<double, 4> border_lengths{180, 360, 180, 360};

struct BorderPlace {
  std::size_t side = 0;
  double along = 0;  // the side

  friend auto operator<=>(const BorderPlace&, const BorderPlace&) = default;
  // From the first corner on.
  [[nodiscard]] double distance() const {
    double sum = along;
    for (std::size_t i = 0; i < side; ++i) sum += border_lengths[i];
    return sum;
  }
};

BorderPlace border_place(const MapPoint& end) {
  const auto [lon, lat] = end.position;
  if (is_pole(end.point)) {
    return lat > 0 ? BorderPlace{3, 180 - lon} : BorderPlace{1, lon + 180};
  }
  return lon > 0 ? BorderPlace{2, lat + 90} : BorderPlace{0, 90 - lat};
}

// A part of a ring from side to side of the rectangle.
struct Chain {
  Loop positions;
  BorderPlace start;
  BorderPlace end;
};

// Snapped to the poles and the antimeridian, and without points that are where the one before is.
std::vector<Point> cleaned(UnitVectors line, bool is_closed) {
  std::vector<Point> points;
  for (const Point& p : line) {
    const Point point = snapped(p);
    if (points.empty() || !(point == points.back())) points.push_back(point);
  }
  while (is_closed && points.size() > 1 && points.back() == points.front()) points.pop_back();
  return points;
}

std::vector<Loop> positions_of_chains(const Trace& trace) {
  std::vector<Loop> chains;
  for (std::size_t k = 0; k < trace.starts.size(); ++k) {
    const std::size_t past =
        k + 1 < trace.starts.size() ? trace.starts[k + 1] : trace.points.size();
    Loop& chain = chains.emplace_back();
    for (std::size_t i = trace.starts[k]; i < past; ++i) {
      const LonLat& position = trace.points[i].position;
      if (chain.empty() || !(chain.back() == position)) chain.push_back(position);
    }
  }
  return chains;
}

// A region that is cut into chains and loops.
class RegionDrawing {
 public:
  RegionDrawing(std::span<const UnitVectors> rings, double tolerance) {
    for (const UnitVectors ring : rings) add(ring, tolerance);
  }

  [[nodiscard]] std::vector<PolygonWithHoles> polygons() {
    if (chains_.empty() && loops_.empty()) return {};
    std::vector<Loop> all = outer_loops();
    if (all.empty()) return {};
    for (const Loop& loop : loops_) {
      for (Loop& hole : simple_loops(loop)) {
        if (doubled_loop_area(hole) < 0)
          all.push_back(std::move(hole));  // else its lines do not resolve it
      }
    }
    split_border(all);
    all = separated_loops(std::move(all));
    const auto is_outer = [](const Loop& loop) { return doubled_loop_area(loop) > 0; };
    const auto first_hole = std::stable_partition(all.begin(), all.end(), is_outer);
    const std::span<Loop> outer(all.begin(), first_hole);
    if (outer.empty()) return {};
    std::vector<PolygonWithHoles> found(outer.size());
    const HoleOwners owners(outer);
    for (auto hole = first_hole; hole != all.end(); ++hole) {
      found[owners.owner_of(*hole)].rings.push_back(std::move(*hole));
    }
    for (std::size_t i = 0; i < outer.size(); ++i) {
      found[i].rings.insert(found[i].rings.begin(), std::move(outer[i]));
      for (Loop& ring : found[i].rings) ring.push_back(ring.front());
    }
    return found;
  }

 private:
  void add(UnitVectors ring, double tolerance) {
    std::vector<Point> points = cleaned(ring, true);
    if (points.size() < 3) return;
    const std::vector<ArcTolerance> tolerances(points.size(), {tolerance, tolerance, {}});
    Trace trace;
    draw(points, tolerances, trace);
    rings_.push_back(std::move(points));
    if (trace.starts.empty()) {
      Loop& loop = loops_.emplace_back();
      for (const MapPoint& point : trace.points) loop.push_back(point.position);
      return;
    }
    std::vector<Loop> parts = positions_of_chains(trace);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const bool is_last = k + 1 == parts.size();
      const std::size_t past = is_last ? trace.points.size() : trace.starts[k + 1];
      chains_.push_back({std::move(parts[k]), border_place(trace.points[trace.starts[k]]),
                         border_place(trace.points[past - 1])});
    }
  }

  // Gives the sides along the border the positions where other loops meet it.
  static void split_border(std::vector<Loop>& loops) {
    std::vector<LonLat> on_border;
    for (const Loop& loop : loops) {
      std::ranges::copy_if(loop, std::back_inserter(on_border),
                           [](const LonLat& p) { return std::abs(p.lon_deg) == 180; });
    }
    if (on_border.empty()) return;
    std::ranges::sort(on_border, {}, &LonLat::lat_deg);
    for (Loop& loop : loops) {
      Loop split;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const LonLat& p = loop[k];
        const LonLat& q = loop[k + 1 == loop.size() ? 0 : k + 1];
        split.push_back(p);
        if (std::abs(p.lon_deg) != 180 || p.lon_deg != q.lon_deg) continue;
        append_between(p, q, on_border, split);
      }
      loop = std::move(split);
    }
  }

  static void append_between(const LonLat& p, const LonLat& q, std::span<const LonLat> positions,
                             Loop& out) {
    const auto [low, high] = std::minmax({p.lat_deg, q.lat_deg});
    const auto first = std::ranges::upper_bound(positions, low, {}, &LonLat::lat_deg);
    const auto past = std::ranges::lower_bound(positions, high, {}, &LonLat::lat_deg);
    const std::size_t begin = out.size();
    for (auto place = first; place < past; ++place) {
      if (place->lon_deg != p.lon_deg || *place == out.back()) continue;
      out.push_back(*place);
    }
    if (q.lat_deg < p.lat_deg) {
      std::reverse(out.begin() + static_cast<std::ptrdiff_t>(begin), out.end());
    }
  }

  // Without chains the largest loop is around the region, or all are holes in the whole rectangle.
  std::vector<Loop> outer_loops() {
    if (!chains_.empty()) return stitched();
    const auto size = [](const Loop& loop) { return std::abs(doubled_loop_area(loop)); };
    const auto largest = std::ranges::max_element(loops_, {}, size);
    if (doubled_loop_area(*largest) <= 0) {
      if (is_sliver(*largest)) return {};
      return {Loop(border_corners.begin(), border_corners.end())};
    }
    Loop outer = std::move(*largest);
    loops_.erase(largest);
    return outer_parts(outer);
  }

  // Whether the region is small and so thin that its loop, drawn as lines, is clockwise.
  [[nodiscard]] bool is_sliver(const Loop& loop) const {
    constexpr double small = 1e-3;  // square radians, far above what is lost between arcs and lines
    const double in_plane = doubled_loop_area(loop) / 2 / degrees_per_radian / degrees_per_radian;
    if (std::abs(in_plane) >= small) return false;
    double area = 0;  // to the left of the rings, up to multiples of 4 pi
    for (const std::vector<Point>& ring : rings_) area += area_on_left(ring);
    return area > 0 && area < small;
  }

  static std::vector<Loop> outer_parts(const Loop& loop) {
    std::vector<Loop> parts = simple_loops(loop);
    if (parts.size() == 1 && doubled_loop_area(parts.front()) < 0)
      std::ranges::reverse(parts.front());
    std::erase_if(parts, [](const Loop& part) { return doubled_loop_area(part) < 0; });
    return parts;
  }

  // Along the border of the rectangle the region begins where a chain ends and ends where one starts. Its
  // first corner is inside if otherwise more of the border were inside twice or less than never: in
  // this count rounding, which may exchange neighbors, hardly weighs.
  [[nodiscard]] bool has_first_corner(std::span<const std::size_t> starts,
                                      std::span<const std::size_t> ends) const {
    double wrong_if_outside = 0;
    double wrong_if_inside = 0;
    double last = 0;
    int inside = 0;  // relative to the corner
    std::size_t s = 0;
    std::size_t e = 0;
    while (s < starts.size() || e < ends.size()) {
      const bool is_end = s == starts.size() ||
                          (e < ends.size() && chains_[ends[e]].end <= chains_[starts[s]].start);
      const double here =
          is_end ? chains_[ends[e]].end.distance() : chains_[starts[s]].start.distance();
      wrong_if_outside += (here - last) * std::max({0, -inside, inside - 1});
      wrong_if_inside += (here - last) * std::max({0, -inside - 1, inside});
      last = here;
      inside += is_end ? 1 : -1;
      ++(is_end ? e : s);
    }
    return wrong_if_inside < wrong_if_outside;
  }

  [[nodiscard]] std::vector<Loop> stitched() const {
    const std::size_t n = chains_.size();
    std::vector<std::size_t> starts(n);
    for (std::size_t i = 0; i < n; ++i) starts[i] = i;
    std::vector<std::size_t> ends = starts;
    std::ranges::stable_sort(starts, {}, [&](std::size_t i) { return chains_[i].start; });
    std::ranges::stable_sort(ends, {}, [&](std::size_t i) { return chains_[i].end; });
    const bool wraps = has_first_corner(starts, ends);
    std::vector<std::size_t> next(n);
    std::vector<std::size_t> last_side(n);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t start = starts[wraps ? (k + 1) % n : k];
      next[ends[k]] = start;
      last_side[ends[k]] = chains_[start].start.side + (wraps && k + 1 == n ? 4 : 0);
    }
    std::vector<Loop> loops;
    std::vector<bool> is_used(n, false);
    for (std::size_t first = 0; first < n; ++first) {
      Loop loop;
      for (std::size_t i = first; !is_used[i]; i = next[i]) {
        is_used[i] = true;
        loop.insert(loop.end(), chains_[i].positions.begin(), chains_[i].positions.end());
        for (std::size_t side = chains_[i].end.side; side < last_side[i]; ++side) {
          loop.push_back(border_corners[side % 4]);
        }
      }
      for (Loop& part : outer_parts(loop)) loops.push_back(std::move(part));
    }
    return loops;
  }

  std::vector<std::vector<Point>> rings_;
  std::vector<Chain> chains_;
  std::vector<Loop> loops_;
};

}  // namespace

std::vector<PolygonWithHoles> region_polygons(std::span<const UnitVectors> rings,
                                              double tolerance) {
  if (!rings.empty()) return RegionDrawing(rings, tolerance).polygons();
  Loop all(border_corners.begin(), border_corners.end());
  all.push_back(all.front());
  return {{{std::move(all)}}};
}

std::vector<std::vector<LonLat>> line_parts(UnitVectors line, bool is_closed, double tolerance) {
  const std::vector<Point> points = cleaned(line, is_closed);
  if (points.size() < (is_closed ? 3U : 2U)) return {};
  Trace trace;
  if (is_closed) {
    const std::vector<ArcTolerance> tolerances(points.size(), {tolerance, tolerance, {}});
    draw(points, tolerances, trace);
  } else {
    draw_line(points, {tolerance, tolerance, {}}, trace);
  }
  if (trace.starts.empty()) {
    trace.points.push_back(trace.points.front());
    trace.starts.push_back(0);
  }
  std::vector<std::vector<LonLat>> parts = positions_of_chains(trace);
  std::erase_if(parts, [](const Loop& part) { return part.size() < 2; });
  return parts;
}

}  // namespace rondel::map
