// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/line_troubles.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "map/map_plane.h"
#include "map/rectangles.h"
#include "map/trace.h"

namespace rondel::map {
namespace {

using TroubleKind = Trouble::TroubleKind;

// Appends the troubles of two sides: ends of one inside of the other, or else a crossing.
void append_troubles(const Line& i, const Line& j, std::vector<Trouble>& troubles) {
  const std::size_t before = troubles.size();
  for (const auto& [line, other] : {std::pair(i, j), std::pair(j, i)}) {
    for (const LonLat& end : {other.from, other.to}) {
      if (is_between(line.from, line.to, end))
        troubles.push_back({TroubleKind::touching, line.from, line.to, end, end});
    }
  }
  if (troubles.size() == before && do_lines_cross(i.from, i.to, j.from, j.to))
    troubles.push_back({TroubleKind::crossing, i.from, i.to, j.from, j.to});
}

bool is_earlier_side(const DirectedLine& x, const DirectedLine& y) {
  return x.from == y.from ? InPlane()(x.to, y.to) : InPlane()(x.from, y.from);
}

bool has_side(const std::vector<DirectedLine>& sorted, const LonLat& a, const LonLat& b) {
  return std::ranges::binary_search(sorted, DirectedLine{a, b}, is_earlier_side);
}

// True if a side of the region starts at a position. Each position of closed loops starts a side.
bool has_start(const std::vector<DirectedLine>& sorted, const LonLat& p) {
  return std::ranges::binary_search(sorted, p, InPlane(), &DirectedLine::from);
}

// Returns the meetings found earlier whose sides and positions still exist.
std::vector<Trouble> lasting_meetings(const RegionMemory& memory,
                                      const std::vector<DirectedLine>& sorted) {
  std::vector<Trouble> troubles;
  std::ranges::copy_if(memory.meetings, std::back_inserter(troubles), [&](const Trouble& t) {
    return has_side(sorted, t.a, t.b) &&
           (t.kind == TroubleKind::crossing ? has_side(sorted, t.c, t.d) : has_start(sorted, t.c));
  });
  return troubles;
}

// Returns all touchings and crossings of sides, and stores them with the sides in `memory`.
std::vector<Trouble> troubles_of(std::span<const DirectedLine> sides, RegionMemory& memory) {
  std::vector<Line> lines;
  lines.reserve(sides.size());
  for (const DirectedLine& side : sides) lines.push_back({side.from, side.to, lines.size()});
  const Rectangles rectangles(lines);
  std::vector<Trouble> troubles;
  if (memory.sides.empty()) {
    rectangles.find_overlapping(
        [&](const Line& i, const Line& j) { append_troubles(i, j, troubles); });
    memory = {{sides.begin(), sides.end()}, troubles, false};
    return troubles;
  }
  if (!memory.are_sorted) std::ranges::sort(memory.sides, is_earlier_side);
  std::vector<DirectedLine> sorted(sides.begin(), sides.end());
  std::ranges::sort(sorted, is_earlier_side);
  troubles = lasting_meetings(memory, sorted);
  std::vector<bool> is_new(sides.size());
  for (std::size_t k = 0; k < sides.size(); ++k)
    is_new[k] = !has_side(memory.sides, sides[k].from, sides[k].to);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (!is_new[k]) continue;
    rectangles.find_overlapping(Rectangle::around(lines[k]), [&](const Line& other) {
      if (other.name < k || (other.name > k && !is_new[other.name]))
        append_troubles(other, lines[k], troubles);
    });
  }
  memory = {std::move(sorted), troubles, true};
  return troubles;
}

// Returns the polygons of simple loops, with a trouble for each misplaced loop.
RegionLook look_at_loops(std::vector<Loop> loops, unsigned threads) {
  RegionLook look;
  PolygonsOfLoops found = polygons_of_loops(std::move(loops), threads);
  look.polygons = std::move(found.polygons);
  for (Loop& loop : found.misplaced) {
    Trouble trouble{TroubleKind::turned};
    trouble.a = loop.front();
    trouble.loop = std::move(loop);
    look.troubles.push_back(std::move(trouble));
  }
  return look;
}

// True if the region is one counterclockwise loop of at most 16 positions that meets itself
// nowhere.
bool is_plain_region(std::span<const Loop> loops) {
  constexpr std::size_t few = 16;
  return loops.size() == 1 && loops[0].size() >= 3 && loops[0].size() <= few &&
         !has_touching(loops) && !has_crossing_lines(loops[0]) && !has_spike(loops[0]) &&
         is_counterclockwise(loops[0]);
}

}  // namespace

RegionLook look_at_region(const std::vector<Loop>& loops, const SharedLines& shared,
                          RegionMemory& memory, unsigned threads) {
  if (shared.is_empty() && is_plain_region(loops)) return look_at_loops(loops, threads);
  std::vector<DirectedLine> sides;
  for (const Loop& loop : loops) shared.append_sides(loop, sides);
  const std::size_t num_sides = sides.size();
  cancel_opposite(sides);
  RegionLook look;
  if (sides.empty()) return look;
  look.troubles = troubles_of(sides, memory);
  if (!look.troubles.empty()) return look;
  if (shared.is_empty() && sides.size() == num_sides && !has_touching(loops))
    return look_at_loops(loops, threads);
  for (const SideWedge& wedge : unpaired_sides(sides)) {
    look.troubles.push_back({wedge.is_paired ? TroubleKind::beside : TroubleKind::unpaired,
                             wedge.at, wedge.first, wedge.at, wedge.second});
  }
  if (!look.troubles.empty()) return look;
  return look_at_loops(traced_loops(sides), threads);
}

bool is_in_trouble(const std::vector<Loop>& loops) {
  RegionMemory memory;
  return !look_at_region(loops, SharedLines(), memory).troubles.empty();
}

}  // namespace rondel::map
