// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/crossing_lines.h"

#include <algorithm>
#include <limits>

namespace rondel::map {
namespace {

struct Line {
  LonLat from;
  LonLat to;
  std::size_t name;
};

struct Rectangle {
  double west;
  double east;
  double south;
  double north;

  static Rectangle around(const Line& line) {
    const auto [west, east] = std::minmax(line.from.lon_deg, line.to.lon_deg);
    const auto [south, north] = std::minmax(line.from.lat_deg, line.to.lat_deg);
    return {west, east, south, north};
  }

  [[nodiscard]] bool overlaps(const Rectangle& other) const {
    return west <= other.east && other.west <= east && south <= other.north && other.south <= north;
  }
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

// Precondition: their rectangles overlap.
bool meet(const Line& a, const Line& b) {
  if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) return false;
  return side(a, b.from) * side(a, b.to) <= 0 && side(b, a.from) * side(b, a.to) <= 0;
}

// The rectangles around the lines, around the lines 2i and 2i + 1, and so on up to one around all:
// lines that follow each other are near each other, so that the rectangles are small. A sweep
// would compare all lines of a meridian with each other.
class Rectangles {
 public:
  explicit Rectangles(const std::vector<Line>& lines) : lines_(lines) {
    all_.reserve(2 * lines.size() + std::numeric_limits<std::size_t>::digits);
    for (const Line& line : lines) all_.push_back(Rectangle::around(line));
    for (std::size_t first = 0; all_.size() - first > 1;) {
      const std::size_t past = all_.size();
      firsts_.push_back(past);
      for (std::size_t i = first; i < past; i += 2) {
        all_.push_back(i + 1 < past ? joined(all_[i], all_[i + 1]) : all_[i]);
      }
      first = past;
    }
    firsts_.push_back(all_.size());
  }

  // Calls `report` with each pair of lines that meet.
  template <typename Report>
  void find_meeting(const Report& report) const {
    if (lines_.size() > 1) within(firsts_.size() - 2, 0, report);
  }

 private:
  static Rectangle joined(const Rectangle& a, const Rectangle& b) {
    return {std::min(a.west, b.west), std::max(a.east, b.east), std::min(a.south, b.south),
            std::max(a.north, b.north)};
  }

  [[nodiscard]] std::size_t size(std::size_t level) const {
    return firsts_[level + 1] - firsts_[level];
  }

  [[nodiscard]] const Rectangle& at(std::size_t level, std::size_t i) const {
    return all_[firsts_[level] + i];
  }

  // The pairs inside one rectangle.
  template <typename Report>
  void within(std::size_t level, std::size_t i, const Report& report) const {
    if (level == 0) return;
    const std::size_t first = 2 * i;
    within(level - 1, first, report);
    if (first + 1 >= size(level - 1)) return;
    within(level - 1, first + 1, report);
    between(level - 1, first, first + 1, report);
  }

  // The pairs of a line in one rectangle with a line in another of the same level.
  template <typename Report>
  void between(std::size_t level, std::size_t i, std::size_t j, const Report& report) const {
    if (!at(level, i).overlaps(at(level, j))) return;
    if (level == 0) {
      if (meet(lines_[i], lines_[j])) report(lines_[i].name, lines_[j].name);
      return;
    }
    const std::size_t past = size(level - 1);
    for (std::size_t a = 2 * i; a < std::min(2 * i + 2, past); ++a) {
      for (std::size_t b = 2 * j; b < std::min(2 * j + 2, past); ++b) {
        between(level - 1, a, b, report);
      }
    }
  }

  const std::vector<Line>& lines_;
  std::vector<Rectangle> all_;          // level by level
  std::vector<std::size_t> firsts_{0};  // of each level, and the end
};

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

bool have_crossing_lines(std::span<const std::vector<LonLat>> rings) {
  constexpr std::size_t few = 16;
  if (rings.size() == 1 && rings[0].size() <= few) {
    return has_crossing_lines(std::span(rings[0]).first(rings[0].size() - 1));
  }
  std::vector<Line> lines;
  for (const std::vector<LonLat>& ring : rings) {
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) lines.push_back({ring[i], ring[i + 1], i});
  }
  bool is_crossed = false;
  Rectangles(lines).find_meeting([&](std::size_t, std::size_t) { is_crossed = true; });
  return is_crossed;
}

std::vector<std::pair<std::size_t, std::size_t>> crossing_lines(const Trace& trace) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  const std::vector<Line> lines = unrolled(trace);
  Rectangles(lines).find_meeting([&](std::size_t i, std::size_t j) { pairs.emplace_back(i, j); });
  return pairs;
}

}  // namespace rondel::map
