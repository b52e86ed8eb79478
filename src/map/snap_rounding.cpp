// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/snap_rounding.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "map/map_grid.h"
#include "map/rectangles.h"

namespace rondel::map {
namespace {

struct GridLine {
  GridPlace low;
  GridPlace high;
  friend auto operator<=>(const GridLine&, const GridLine&) = default;
};

// A line of the grid as a side of a region: how many times more often it leads from low to high
// than back.
struct GridSide {
  GridLine line;
  std::size_t region;
  int count;
};

void append_side(const GridPlace& from, const GridPlace& to, std::size_t region, int count,
                 std::vector<GridSide>& sides) {
  if (from == to) return;
  const bool is_upward = from < to;
  sides.push_back(
      {is_upward ? GridLine{from, to} : GridLine{to, from}, region, is_upward ? count : -count});
}

// All lines, each once, in the order in which they first occur, so that near lines stay near each
// other; with the sides that lie on each.
class GridLines {
 public:
  explicit GridLines(std::vector<GridSide> sides) : sides_(std::move(sides)) {
    std::vector<std::size_t> order(sides_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(
        order, {}, [&](std::size_t i) { return std::tuple(sides_[i].line, sides_[i].region, i); });
    std::vector<Group> groups;
    for (auto at = order.begin(); at != order.end();) {
      const GridLine line = sides_[*at].line;
      Group group{order.size(), kept_.size(), 0};
      while (at != order.end() && sides_[*at].line == line) {
        GridSide sum{line, sides_[*at].region, 0};
        for (; at != order.end() && sides_[*at].line == line && sides_[*at].region == sum.region;
             ++at) {
          sum.count += sides_[*at].count;
          group.first_side = std::min(group.first_side, *at);
        }
        if (sum.count != 0) kept_.push_back(sum);
      }
      group.past = kept_.size();
      if (group.past > group.begin) groups.push_back(group);
    }
    std::ranges::sort(groups, {}, &Group::first_side);
    groups_ = std::move(groups);
    sides_.clear();
  }

  [[nodiscard]] std::size_t size() const { return groups_.size(); }
  [[nodiscard]] const GridLine& operator[](std::size_t i) const {
    return kept_[groups_[i].begin].line;
  }
  [[nodiscard]] std::span<const GridSide> sides(std::size_t i) const {
    return std::span(kept_).subspan(groups_[i].begin, groups_[i].past - groups_[i].begin);
  }

 private:
  struct Group {
    std::size_t first_side;
    std::size_t begin;
    std::size_t past;
  };
  std::vector<GridSide> sides_;
  std::vector<GridSide> kept_;
  std::vector<Group> groups_;
};

std::vector<Line> lines_on_map(const GridLines& lines) {
  std::vector<Line> all;
  all.reserve(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
    all.push_back({off_grid(lines[i].low), off_grid(lines[i].high), i});
  return all;
}

// True if a place lies on a line and is no end of it.
bool has_inside(const GridLine& line, const GridPlace& p) {
  return turn_on_grid(line.low, line.high, p) == 0 &&
         is_before_along(line.low, line.high, line.low, p) &&
         is_before_along(line.low, line.high, p, line.high);
}

struct Meetings {
  std::vector<GridPlace> crossings;  // the pixels of crossings
  bool has_any = false;              // true if lines cross, or an end of one is inside of another
};

Meetings meetings_of(const GridLines& lines, const Rectangles& rectangles) {
  Meetings found;
  rectangles.find_overlapping([&](const Line& i, const Line& j) {
    const GridLine& p = lines[i.name];
    const GridLine& q = lines[j.name];
    const int c = turn_on_grid(p.low, p.high, q.low);
    const int d = turn_on_grid(p.low, p.high, q.high);
    const int a = turn_on_grid(q.low, q.high, p.low);
    const int b = turn_on_grid(q.low, q.high, p.high);
    if (c * d < 0 && a * b < 0) {
      found.crossings.push_back(crossing_pixel(p.low, p.high, q.low, q.high));
      found.has_any = true;
    } else if (has_inside(p, q.low) || has_inside(p, q.high) || has_inside(q, p.low) ||
               has_inside(q, p.high)) {
      found.has_any = true;
    }
  });
  return found;
}

std::vector<GridPlace> hot_pixels(const GridLines& lines, std::vector<GridPlace> crossings) {
  std::vector<GridPlace> pixels = std::move(crossings);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    pixels.push_back(lines[i].low);
    pixels.push_back(lines[i].high);
  }
  std::ranges::sort(pixels);
  pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
  return pixels;
}

Rectangle rectangle_of_pixel(const GridPlace& c) {
  const auto [west, south] = off_grid({c.x - 1, c.y - 1});
  const auto [east, north] = off_grid({c.x + 1, c.y + 1});
  return {west, east, south, north};
}

// Returns the sides along the polylines that the lines become.
std::vector<GridSide> rounded(const GridLines& lines, const Rectangles& rectangles,
                              std::vector<GridPlace> crossings) {
  std::vector<std::vector<GridPlace>> inner(lines.size());
  const std::vector<GridPlace> pixels = hot_pixels(lines, std::move(crossings));
  for (const GridPlace& pixel : pixels) {
    rectangles.find_overlapping(rectangle_of_pixel(pixel), [&](const Line& line) {
      const auto& [low, high] = lines[line.name];
      if (pixel != low && pixel != high && meets_pixel(low, high, pixel))
        inner[line.name].push_back(pixel);
    });
  }
  std::vector<GridSide> sides;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const GridLine& line = lines[i];
    std::ranges::sort(inner[i], [&](const GridPlace& p, const GridPlace& q) {
      return is_before_along(line.low, line.high, p, q);
    });
    inner[i].push_back(line.high);
    for (const GridSide& side : lines.sides(i)) {
      GridPlace from = line.low;
      for (const GridPlace& to : inner[i]) {
        append_side(from, to, side.region, side.count, sides);
        from = to;
      }
    }
  }
  return sides;
}

}  // namespace

std::vector<NodedLine> snap_rounded(std::span<const std::vector<DirectedLine>> sides_of_regions) {
  std::vector<GridSide> sides;
  for (std::size_t region = 0; region < sides_of_regions.size(); ++region) {
    for (const DirectedLine& side : sides_of_regions[region])
      append_side(on_grid(side.from), on_grid(side.to), region, 1, sides);
  }
  // One round suffices; the second one confirms it.
  for (;;) {
    const GridLines lines(std::move(sides));
    const std::vector<Line> on_map = lines_on_map(lines);
    const Rectangles rectangles(on_map);
    Meetings meetings = meetings_of(lines, rectangles);
    if (meetings.has_any) {
      sides = rounded(lines, rectangles, std::move(meetings.crossings));
      continue;
    }
    std::vector<NodedLine> noded;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      NodedLine& line = noded.emplace_back(NodedLine{on_map[i].from, on_map[i].to, {}});
      for (const GridSide& side : lines.sides(i)) line.counts.push_back({side.region, side.count});
    }
    return noded;
  }
}

}  // namespace rondel::map
