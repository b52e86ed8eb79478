// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/trace.h"

#include <algorithm>
#include <cmath>

namespace rondel::map {
namespace {

// Returns the pole within merge_distance of the arc between two points that are not poles, or null.
const Point* pole_on_arc(const Point& p, const Point& q) {
  static constexpr Point north{0, 0, 1};
  static constexpr Point south{0, 0, -1};
  // The arc turns by less than 90 degrees around the axis.
  if (p.x * q.x + p.y * q.y >= 0) return nullptr;
  const Point normal = cross(p, q - p);
  if (std::abs(p.x * q.y - p.y * q.x) > merge_distance * norm(normal)) return nullptr;
  const double height = p.z * distance_from_axis(q) + q.z * distance_from_axis(p);
  return height > 0 ? &north : &south;
}

// Returns the point where an arc from the west to the east crosses the plane of the antimeridian.
Point crossing(const Point& west, const Point& east) {
  if (east.y == 0) return east;
  return normalized(Point{west.x * east.y - east.x * west.y, 0, west.z * east.y - east.z * west.y});
}

class Drawing {
 public:
  Drawing(Trace& trace, MapPositions positions) : trace_(trace), positions_(positions) {
    trace_.points.clear();
    trace_.arcs.clear();
    trace_.starts.clear();
  }

  void add_arc(const Point& p, const Point& q, std::uint32_t arc, const ArcTolerance& tolerance) {
    arc_ = arc;
    if (is_pole(p)) {
      leave_pole(p, q);
    } else if (is_pole(q)) {
      reach_pole(p, q);
    } else if (const Point* const pole = pole_on_arc(p, q)) {
      reach_pole(p, *pole);
      leave_pole(*pole, q);
    } else {
      add_open_arc(p, q, tolerance);
    }
  }

  // Adds the end of an open line, unless it is a pole, which has been added.
  void finish_at(const Point& end) {
    if (!is_pole(end)) add(on_map(end));
    std::vector<std::size_t>& starts = trace_.starts;
    if (starts.empty() || starts.front() != 0) starts.insert(starts.begin(), 0);
  }

  void finish() {
    rotate_to_first_start();
    trace_.has_north_corners = has_north_corners();
  }

 private:
  void add(const MapPoint& point) {
    trace_.points.push_back(point);
    trace_.arcs.push_back(arc_);
  }

  // Returns a point with its position, which the arc before has computed if it ended there.
  const MapPoint& on_map(const Point& p) {
    if (!(p == last_.point)) last_ = map_point(p, positions_);
    return last_;
  }

  // Adds the line from a point to a pole, which follows a meridian and needs no points between.
  void reach_pole(const Point& p, const Point& pole) {
    const MapPoint start = on_map(p);
    add(start);
    add({pole, {start.position.lon_deg, pole.z * 90}});
  }

  void leave_pole(const Point& pole, const Point& q) {
    trace_.starts.push_back(trace_.points.size());
    add({pole, {on_map(q).position.lon_deg, pole.z * 90}});
  }

  void add_open_arc(const Point& p, const Point& q, const ArcTolerance& tolerance) {
    const bool east = is_east(p);
    const MapPoint start = on_map(p);
    const MapPoint end = on_map(q);
    add(start);
    const bool crosses = east != is_east(q);
    const Point middle = !crosses ? Point{} : east ? crossing(q, p) : crossing(p, q);
    if (!crosses || middle.x > 0) {
      add_inner(start, end, tolerance);
      return;
    }
    const MapPoint before = map_point(middle, east, positions_);
    const MapPoint after = map_point(middle, !east, positions_);
    add_inner(start, before, tolerance);
    add(before);
    trace_.starts.push_back(trace_.points.size());
    add(after);
    add_inner(after, end, tolerance);
    winding_ += east ? 1 : -1;
  }

  void add_inner(const MapPoint& p, const MapPoint& q, const ArcTolerance& tolerance) {
    if (p.point == q.point) return;
    append_arc(p, q, tolerance, trace_.points);
    trace_.arcs.resize(trace_.points.size(), arc_);
  }

  // Rotates the points so that the ring begins with the start of its first chain.
  void rotate_to_first_start() {
    std::vector<std::size_t>& starts = trace_.starts;
    if (starts.empty()) return;
    const std::size_t shift = starts.front();
    const auto middle = static_cast<std::ptrdiff_t>(shift);
    std::rotate(trace_.points.begin(), trace_.points.begin() + middle, trace_.points.end());
    std::rotate(trace_.arcs.begin(), trace_.arcs.begin() + middle, trace_.arcs.end());
    for (std::size_t& start : starts) start -= shift;
  }

  // True if the region has the corners at the north pole inside.
  //
  // At a pole on the ring the region is a sector: at the north pole from the longitude at which the
  // ring leaves eastward to that at which it arrives, at the south pole the other way round.
  // Otherwise the region has the north pole inside if the ring winds around it once. For that count
  // a ring through the south pole is moved into its region; its antipode at the north pole is no
  // inner point, as the region is convex.
  bool has_north_corners() {
    bool visits_north = false;
    bool is_inside = false;
    for (std::size_t k = 0; k < trace_.starts.size(); ++k) {
      const std::size_t start = trace_.starts[k];
      const MapPoint& begin = trace_.points[start];
      if (!is_pole(begin.point)) continue;
      // The last point of the chain before; the point before that one has the same longitude.
      const MapPoint& end = trace_.points[start == 0 ? trace_.points.size() - 1 : start - 1];
      const double turn = begin.position.lon_deg - end.position.lon_deg;
      if (begin.point.z < 0) {
        winding_ += turn < 0 ? 1 : 0;
      } else {
        visits_north = true;
        is_inside = is_inside || turn > 0;
      }
    }
    return visits_north ? is_inside : winding_ == 1;
  }

  Trace& trace_;
  MapPositions positions_;
  MapPoint last_{};
  std::uint32_t arc_ = 0;
  int winding_ = 0;
};

}  // namespace

void draw(std::span<const Point> ring, std::span<const ArcTolerance> tolerances, Trace& trace,
          MapPositions positions) {
  Drawing drawing(trace, positions);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    drawing.add_arc(ring[i], ring[(i + 1) % ring.size()], static_cast<std::uint32_t>(i),
                    tolerances[i]);
  }
  drawing.finish();
}

void draw_line(std::span<const Point> line, const ArcTolerance& tolerance, Trace& trace,
               MapPositions positions) {
  Drawing drawing(trace, positions);
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    drawing.add_arc(line[i], line[i + 1], static_cast<std::uint32_t>(i), tolerance);
  }
  drawing.finish_at(line.back());
}

}  // namespace rondel::map
