// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/lonlat_trace.h"

#include <algorithm>
#include <cmath>

namespace rondel::io {
namespace {

// The antimeridian belongs to the east: think of it as shifted by an infinitesimal to the west, so
// that every point but a pole is on one side.
bool is_east(const Point& p) { return p.y >= 0; }

// The pole within merge_distance of the arc between two points that are not poles; null if none.
const Point* pole_on_arc(const Point& p, const Point& q) {
  static constexpr Point north{0, 0, 1};
  static constexpr Point south{0, 0, -1};
  if (p.x * q.x + p.y * q.y >= 0) return nullptr;  // the arc does not turn by 90 degrees around it
  const Point normal = cross(p, difference(q, p));
  if (std::abs(p.x * q.y - p.y * q.x) > merge_distance * norm(normal)) return nullptr;
  const double height = p.z * std::hypot(q.x, q.y) + q.z * std::hypot(p.x, p.y);
  return height > 0 ? &north : &south;
}

// The point where an arc from the west to the east crosses the plane of the antimeridian.
Point crossing(const Point& west, const Point& east) {
  return normalized({west.x * east.y - east.x * west.y, 0, west.z * east.y - east.z * west.y});
}

class Drawing {
 public:
  explicit Drawing(Trace& trace) : trace_(trace) {}

  void add_arc(const Point& p, const Point& q, std::uint32_t arc, double tolerance) {
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

  // Moves the beginning of the ring, which is the end of the last chain, behind it; counts how
  // often the ring winds around the north pole.
  void finish() {
    std::vector<std::size_t>& starts = trace_.starts;
    if (!starts.empty()) {
      const std::size_t shift = starts.front();
      const auto middle = static_cast<std::ptrdiff_t>(shift);
      std::rotate(trace_.points.begin(), trace_.points.begin() + middle, trace_.points.end());
      std::rotate(trace_.arcs.begin(), trace_.arcs.begin() + middle, trace_.arcs.end());
      for (std::size_t& start : starts) start -= shift;
    }
    trace_.has_north_corners = visits_north_ ? north_sector_meets_antimeridian_ : winding_ == 1;
  }

 private:
  void add(const MapPoint& point) {
    trace_.points.push_back(point);
    trace_.arcs.push_back(arc_);
  }

  // Straight up or down a meridian, so nothing lies between the pole and the other end.
  void reach_pole(const Point& p, const Point& pole) {
    const LonLat position = lonlat_of(p, is_east(p));
    add({p, position});
    add({pole, {position.lon_deg, pole.z > 0 ? 90.0 : -90.0}});
    arrival_ = position.lon_deg;
  }

  void leave_pole(const Point& pole, const Point& q) {
    const double lon = lonlat_of(q, is_east(q)).lon_deg;
    trace_.starts.push_back(trace_.points.size());
    add({pole, {lon, pole.z > 0 ? 90.0 : -90.0}});
    departures_.push_back({pole.z > 0, lon});
  }

  void add_open_arc(const Point& p, const Point& q, double tolerance) {
    const bool east = is_east(p);
    const MapPoint start{p, lonlat_of(p, east)};
    const MapPoint end{q, lonlat_of(q, is_east(q))};
    add(start);
    if (east != is_east(q)) {
      const Point middle = east ? crossing(q, p) : crossing(p, q);
      if (middle.x < 0) {
        const MapPoint first{middle, lonlat_of(middle, east)};
        const MapPoint second{middle, lonlat_of(middle, !east)};
        add_inner(start, first, tolerance);
        add(first);
        trace_.starts.push_back(trace_.points.size());
        add(second);
        add_inner(second, end, tolerance);
        winding_ += east ? 1 : -1;
        return;
      }
    }
    add_inner(start, end, tolerance);
  }

  void add_inner(const MapPoint& p, const MapPoint& q, double tolerance) {
    if (p.point == q.point) return;
    append_arc(p, q, tolerance, trace_.points);
    trace_.arcs.resize(trace_.points.size(), arc_);
  }

  Trace& trace_;
  std::uint32_t arc_ = 0;
  int winding_ = 0;
  bool visits_north_ = false;
  bool north_sector_meets_antimeridian_ = false;
  double arrival_ = 0;
  struct Departure {
    bool north;
    double lon;
  };
  std::vector<Departure> departures_;
};

}  // namespace

}  // namespace rondel::io
