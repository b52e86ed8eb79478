// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <numeric>
#include <utility>

#include "exact/angles.h"
#include "map/planar_loops.h"
#include "map/ring_area.h"
#include "map/trace.h"
#include "map/valid_regions.h"

namespace rondel::map {
namespace {

// The corners of the rectangle, counterclockwise from the one in the north west, and the lengths of
// its sides in degrees.
constexpr std::array<LonLat, 4> border_corners{{{-180, -90}, {180, -90}, {180, 90}, {-180, 90}}};
constexpr std::array<double, 4> border_lengths{180, 360, 180, 360};

// A place on the border of the rectangle.
struct BorderPlace {
  std::size_t side = 0;
  double along = 0;  // degrees along the side

  friend auto operator<=>(const BorderPlace&, const BorderPlace&) = default;
  // Returns the distance along the border from the first corner, in degrees.
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

// A part of a ring that runs from side to side of the rectangle.
struct Chain {
  Loop positions;
  BorderPlace start;
  BorderPlace end;
};

// Returns the points of a line, snapped to the poles and the antimeridian, without a point that
// equals the one before it.
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

// Cuts the border of a region into chains and closed loops, and joins the chains along the border
// of the rectangle.
class RegionDrawing {
 public:
  RegionDrawing(std::span<const UnitVectors> rings, double tolerance) {
    for (const UnitVectors ring : rings) {
      const std::vector<Point> points = cleaned(ring, true);
      if (points.size() < 3) continue;
      add(points, std::vector<ArcTolerance>(points.size(), {tolerance, tolerance, {}}));
    }
  }

  [[nodiscard]] DrawnRegion drawn() && {
    if (!chains_.empty()) {
      std::vector<Loop> joined = stitched();
      loops_.insert(loops_.end(), joined.begin(), joined.end());
    } else if (loops_.empty()) {
      // All points of each ring are one on the map: the region is tiny, or its complement is.
      border_ = BorderKnowledge::seems_outside;
    } else if (has_border()) {
      loops_.push_back(border_loop());
    }
    return {std::move(loops_), border_};
  }

 private:
  void add(std::span<const Point> ring, std::span<const ArcTolerance> tolerances) {
    Trace trace;
    draw(ring, tolerances, trace, MapPositions::written);
    rings_.emplace_back(ring.begin(), ring.end());
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

  // Returns the area that lines of the plane enclose on the sphere, in steradians: the integral of
  // the sine of latitude over longitude.
  static double area_of_lines(std::span<const Loop> loops) {
    double area = 0;
    for (const Loop& loop : loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const LonLat& p = loop[k];
        const LonLat& q = loop[k + 1 < loop.size() ? k + 1 : 0];
        const double middle = std::midpoint(p.lat_deg, q.lat_deg);
        area -= (q.lon_deg - p.lon_deg) * exact::sine_cosine_of_degrees(middle).sine;
      }
    }
    return area / degrees_per_radian;
  }

  static constexpr double hemisphere = 2 * std::numbers::pi;

  // Returns the area of the region, from 0 to 4 pi. The rings determine it up to multiples of 4 pi.
  [[nodiscard]] double area_on_sphere() const {
    const double area = areas_on_left(rings_);
    return area - 2 * hemisphere * std::floor(area / (2 * hemisphere));
  }

  // True if a region whose rings do not reach the border of the rectangle has the border inside.
  // Then its loops are holes, whose (negative) area is that of the region minus that of the sphere.
  // Lines may be far from the arcs of a thin region, so that the areas of lines and of arcs have
  // different signs, but they never differ by half of the sphere.
  [[nodiscard]] bool has_border() {
    const double drawn = area_of_lines(loops_);
    if (std::abs(drawn) > hemisphere) return drawn < 0;
    const double own = area_on_sphere();
    const bool is_inside = own > hemisphere + drawn;
    if (!is_rounding(own)) return is_inside;
    border_ = is_inside ? BorderKnowledge::seems_inside : BorderKnowledge::seems_outside;
    return false;
  }

  [[nodiscard]] bool is_rounding(double area) const {
    std::size_t num_points = 0;
    for (const std::vector<Point>& ring : rings_) num_points += ring.size();
    return std::abs(std::remainder(area, 4 * std::numbers::pi)) <=
           merge_distance * static_cast<double>(num_points);
  }

  // True if the first corner of the border is inside of the region. Along the border the region
  // begins where a chain ends and ends where a chain starts. The corner is inside if otherwise a
  // longer part of the border would be inside twice, or less than never. Neighbors that rounding
  // has exchanged hardly weigh in this count.
  [[nodiscard]] bool has_first_corner(std::span<const std::size_t> starts,
                                      std::span<const std::size_t> ends) const {
    double wrong_if_outside = 0;
    double wrong_if_inside = 0;
    double last = 0;
    int inside = 0;  // how often the place is inside, minus that of the corner
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

  // Joins the chains along the border. If the area of the rings is within rounding, the loops are
  // those of the part to the left of all chains, and border_ says whether the region seems to be
  // all but that part.
  [[nodiscard]] std::vector<Loop> stitched() {
    const std::size_t n = chains_.size();
    std::vector<std::size_t> starts(n);
    for (std::size_t i = 0; i < n; ++i) starts[i] = i;
    std::vector<std::size_t> ends = starts;
    std::ranges::stable_sort(starts, {}, [&](std::size_t i) { return chains_[i].start; });
    std::ranges::stable_sort(ends, {}, [&](std::size_t i) { return chains_[i].end; });
    const int likely = has_first_corner(starts, ends) ? 1 : 0;
    std::vector<Loop> joined = joined_chains(starts, ends, likely == 1);
    const int times = times_around(area_of_lines(joined) + area_of_lines(loops_));
    return times == 0 ? joined : joined_around(starts, ends, likely - times);
  }

  // Returns how many times more often than the region the lines, which enclose `drawn` steradians,
  // go around the whole sphere.
  [[nodiscard]] int times_around(double drawn) {
    const double own = area_on_sphere();
    const bool is_known = !is_rounding(own);
    const auto times =
        static_cast<int>(std::lround((drawn - (is_known ? own : 0)) / (2 * hemisphere)));
    if (!is_known)
      border_ = times == 1 ? BorderKnowledge::seems_inside : BorderKnowledge::seems_outside;
    return times;
  }

  // Joins the chains so that the first corner of the border is `times` times inside. This is 0 or 1
  // except where chains that are nearer to each other than lines to arcs have changed places next
  // to a pole. Then whole borders are added, and the region is where lines go around least often.
  [[nodiscard]] std::vector<Loop> joined_around(std::span<const std::size_t> starts,
                                                std::span<const std::size_t> ends,
                                                int times) const {
    std::vector<Loop> joined = joined_chains(starts, ends, times > 0);
    for (int k = times > 0 ? 1 : 0; k != times; k += times > 0 ? 1 : -1) {
      joined.push_back(border_loop());
      if (times < 0) std::ranges::reverse(joined.back());
    }
    return joined;
  }

  [[nodiscard]] std::vector<Loop> joined_chains(std::span<const std::size_t> starts,
                                                std::span<const std::size_t> ends,
                                                bool wraps) const {
    const std::size_t n = chains_.size();
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
      if (!loop.empty()) loops.push_back(std::move(loop));
    }
    return loops;
  }

  std::vector<std::vector<Point>> rings_;
  std::vector<Chain> chains_;
  std::vector<Loop> loops_;
  BorderKnowledge border_ = BorderKnowledge::is_known;
};

}  // namespace

std::vector<LonLat> border_loop() { return {border_corners.begin(), border_corners.end()}; }

DrawnRegion draw_region(std::span<const UnitVectors> rings, double tolerance) {
  if (!rings.empty()) return RegionDrawing(rings, tolerance).drawn();
  return {{border_loop()}, BorderKnowledge::is_known};
}

std::vector<Loop> region_loops(std::span<const UnitVectors> rings, double tolerance) {
  DrawnRegion region = draw_region(rings, tolerance);
  if (region.border == BorderKnowledge::seems_inside) region.loops.push_back(border_loop());
  return std::move(region.loops);
}

std::vector<PolygonWithHoles> region_polygons(std::span<const UnitVectors> rings,
                                              double tolerance) {
  return std::move(valid_regions({region_loops(rings, tolerance)}, 1).front());
}

std::vector<std::vector<LonLat>> line_parts(UnitVectors line, bool is_closed, double tolerance) {
  const std::vector<Point> points = cleaned(line, is_closed);
  if (points.size() < (is_closed ? 3U : 2U)) return {};
  Trace trace;
  if (is_closed) {
    const std::vector<ArcTolerance> tolerances(points.size(), {tolerance, tolerance, {}});
    draw(points, tolerances, trace, MapPositions::written);
  } else {
    draw_line(points, {tolerance, tolerance, {}}, trace, MapPositions::written);
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
