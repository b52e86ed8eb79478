// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/crossing_lines.h"

#include <algorithm>

namespace rondel::io {
namespace {

struct Line {
  LonLat from;
  LonLat to;
  std::size_t name;

  [[nodiscard]] double west() const { return std::min(from.lon_deg, to.lon_deg); }
  [[nodiscard]] double east() const { return std::max(from.lon_deg, to.lon_deg); }
  [[nodiscard]] double south() const { return std::min(from.lat_deg, to.lat_deg); }
  [[nodiscard]] double north() const { return std::max(from.lat_deg, to.lat_deg); }
};

// By how much the longitude turns beyond the rectangle where one chain ends and the next starts:
// across the antimeridian, or around the pole that both touch with the region to the left.
double turn(const MapPoint& end, const MapPoint& start) {
  const double step = start.position.lon_deg - end.position.lon_deg;
  if (!is_pole(start.point)) return step < 0 ? 360 : -360;
  if (start.point.z > 0) return step > 0 ? -360 : 0;
  return step < 0 ? 360 : 0;
}

// The chains one after the other as if the rectangle had no sides.
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

double side(const Line& line, const LonLat& p) {
  return (line.to.lon_deg - line.from.lon_deg) * (p.lat_deg - line.from.lat_deg) -
         (line.to.lat_deg - line.from.lat_deg) * (p.lon_deg - line.from.lon_deg);
}

bool meet(const Line& a, const Line& b) {
  if (a.north() < b.south() || b.north() < a.south()) return false;
  if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) return false;
  return side(a, b.from) * side(a, b.to) <= 0 && side(b, a.from) * side(b, a.to) <= 0;
}

}  // namespace

std::vector<std::size_t> crossing_lines(const Trace& trace) {
  std::vector<std::size_t> found;
  std::vector<Line> lines = unrolled(trace);
  std::sort(lines.begin(), lines.end(),
            [](const Line& a, const Line& b) { return a.west() < b.west(); });
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double east = lines[i].east();
    for (std::size_t j = i + 1; j < lines.size() && lines[j].west() <= east; ++j) {
      if (!meet(lines[i], lines[j])) continue;
      found.push_back(lines[i].name);
      found.push_back(lines[j].name);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace rondel::io
