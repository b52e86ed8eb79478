// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "map/map_plane.h"
#include "map/rectangles.h"
#include "map/trace.h"

namespace rondel::map {
namespace {

// Returns by how many degrees the longitude changes beyond the rectangle between the end of one
// chain and the start of the next: 360 across the antimeridian, or the turn around the pole that
// both touch, with the region to the left.
double turn(const MapPoint& end, const MapPoint& start) {
  const double step = start.position.lon_deg - end.position.lon_deg;
  if (!is_pole(start.point)) return step < 0 ? 360 : -360;
  if (start.point.z > 0) return step > 0 ? -360 : 0;
  return step < 0 ? 360 : 0;
}

// Returns the lines of all chains one after the other, with longitudes that continue beyond the
// sides of the rectangle.
std::vector<Line> unrolled(const Trace& trace) {
  std::vector<Line> lines;
  lines.reserve(trace.points.size());
  const auto add = [&](std::size_t i, const LonLat& to, double shift) {
    const LonLat& from = trace.points[i].position;
    if (from == to) return;
    lines.push_back({{from.lon_deg + shift, from.lat_deg}, {to.lon_deg + shift, to.lat_deg}, i});
  };
  double shift = 0;
  std::size_t chain = 1;
  for (std::size_t i = 0; i + 1 < trace.points.size(); ++i) {
    if (chain < trace.starts.size() && i + 1 == trace.starts[chain]) {
      shift += turn(trace.points[i], trace.points[i + 1]);
      ++chain;
      continue;
    }
    add(i, trace.points[i + 1].position, shift);
  }
  if (trace.starts.empty()) add(trace.points.size() - 1, trace.points.front().position, 0);
  return lines;
}

// True if two lines meet in a point that is not an end of both. Precondition: their rectangles
// overlap.
bool meet(const Line& a, const Line& b) {
  if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) return false;
  return do_lines_cross(a.from, a.to, b.from, b.to) || is_between(a.from, a.to, b.from) ||
         is_between(a.from, a.to, b.to) || is_between(b.from, b.to, a.from) ||
         is_between(b.from, b.to, a.to);
}

}  // namespace

bool has_crossing_lines(std::span<const LonLat> loop) {
  const auto line = [&](std::size_t i) {
    return Line{loop[i], loop[i + 1 == loop.size() ? 0 : i + 1], i};
  };
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const Line a = line(i);
    const Rectangle around = Rectangle::around(a);
    for (std::size_t j = 0; j + 1 < i; ++j) {
      const Line b = line(j);
      if (around.overlaps(Rectangle::around(b)) && meet(b, a)) return true;
    }
  }
  return false;
}

std::vector<std::pair<std::size_t, std::size_t>> crossing_lines(const Trace& trace) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  const std::vector<Line> lines = unrolled(trace);
  Rectangles(lines).find_overlapping([&](const Line& a, const Line& b) {
    if (meet(a, b)) pairs.emplace_back(a.name, b.name);
  });
  return pairs;
}

}  // namespace rondel::map
