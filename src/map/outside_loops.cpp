// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "map/map_plane.h"
#include "map/planar_loops.h"

namespace rondel::map {
namespace {

// A side with its lower end first; `is_upward` is true if it leads from there.
struct SideEnds {
  LonLat low;
  LonLat high;
  bool is_upward;
};

bool are_same_ends(const SideEnds& x, const SideEnds& y) {
  return x.low == y.low && x.high == y.high;
}

void append_ends(const LonLat& p, const LonLat& q, std::vector<SideEnds>& sides) {
  if (p == q) return;
  const bool is_upward = InPlane()(p, q);
  sides.push_back({is_upward ? p : q, is_upward ? q : p, is_upward});
}

// Returns the side of the map on which a position of its border lies (0 south, 1 east, 2 north, 3
// west) and its place along that side counterclockwise; exact.
std::pair<int, double> place_on_border(const LonLat& p) {
  if (p.lat_deg == -90) return {0, p.lon_deg};
  if (p.lon_deg == 180) return {1, p.lat_deg};
  return p.lat_deg == 90 ? std::pair(2, -p.lon_deg) : std::pair(3, -p.lat_deg);
}

// Appends the border of the map, clockwise, divided at all positions that lie on it.
void append_border(std::vector<LonLat> positions, std::vector<SideEnds>& sides) {
  std::ranges::sort(positions, {}, &place_on_border);
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  for (std::size_t k = 0; k < positions.size(); ++k)
    append_ends(positions[k], positions[k == 0 ? positions.size() - 1 : k - 1], sides);
}

std::vector<SideEnds> all_sides(std::span<const std::vector<Loop>> regions) {
  std::vector<SideEnds> sides;
  std::vector<LonLat> on_border = border_loop();
  for (const std::vector<Loop>& loops : regions) {
    for (const Loop& loop : loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const LonLat& p = loop[k];
        append_ends(p, loop[k + 1 < loop.size() ? k + 1 : 0], sides);
        if (std::abs(p.lon_deg) == 180 || std::abs(p.lat_deg) == 90) on_border.push_back(p);
      }
    }
  }
  append_border(std::move(on_border), sides);
  return sides;
}

// Removes the sides that occur in both directions and returns the rest, reversed.
std::vector<DirectedLine> single_sides(std::vector<SideEnds> sides) {
  // An unstable sort falls back to heaps for the sides of many loops, which is slower.
  std::ranges::stable_sort(sides, [](const SideEnds& x, const SideEnds& y) {
    return x.low == y.low ? InPlane()(x.high, y.high) : InPlane()(x.low, y.low);
  });
  std::vector<DirectedLine> single;
  for (auto first = sides.begin(); first != sides.end();) {
    auto past = first;
    std::ptrdiff_t count = 0;
    for (; past != sides.end() && are_same_ends(*past, *first); ++past)
      count += past->is_upward ? 1 : -1;
    for (; count > 0; --count) single.push_back({first->high, first->low});
    for (; count < 0; ++count) single.push_back({first->low, first->high});
    first = past;
  }
  return single;
}

}  // namespace

std::vector<Loop> outside_loops(std::span<const std::vector<Loop>> regions) {
  std::vector<DirectedLine> sides = single_sides(all_sides(regions));
  const auto before = [](const DirectedLine& x, const DirectedLine& y) {
    return x.from == y.from ? InPlane()(x.to, y.to) : InPlane()(x.from, y.from);
  };
  std::ranges::sort(sides, before);
  std::vector<bool> is_used(sides.size(), false);
  std::vector<Loop> loops;
  for (std::size_t first = 0; first < sides.size(); ++first) {
    Loop loop;
    for (std::size_t i = first; i < sides.size() && !is_used[i];) {
      is_used[i] = true;
      loop.push_back(sides[i].from);
      const LonLat& end = sides[i].to;
      const auto next = std::ranges::lower_bound(sides, end, InPlane(), &DirectedLine::from);
      i = static_cast<std::size_t>(next - sides.begin());
      while (i < sides.size() && sides[i].from == end && is_used[i]) ++i;
      if (i < sides.size() && !(sides[i].from == end)) break;
    }
    if (!loop.empty()) loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace rondel::map
