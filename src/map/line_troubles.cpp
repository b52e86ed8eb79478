// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/line_troubles.h"

#include <algorithm>
#include <utility>

#include "map/crossing_lines.h"
#include "map/map_plane.h"
#include "map/rectangles.h"

namespace rondel::map {
namespace {

using TroubleKind = Trouble::TroubleKind;

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

std::vector<Trouble> troubles_of(std::span<const DirectedLine> sides) {
  std::vector<Line> lines;
  lines.reserve(sides.size());
  for (const DirectedLine& side : sides) lines.push_back({side.from, side.to, lines.size()});
  std::vector<Trouble> troubles;
  Rectangles(lines).find_overlapping(
      [&](const Line& i, const Line& j) { append_troubles(i, j, troubles); });
  return troubles;
}

RegionLook look_at_loops(std::vector<Loop> loops) {
  RegionLook look;
  PolygonsOfLoops found = polygons_of_loops(std::move(loops));
  look.polygons = std::move(found.polygons);
  for (Loop& loop : found.misplaced) {
    Trouble trouble{TroubleKind::turned};
    trouble.a = loop.front();
    trouble.loop = std::move(loop);
    look.troubles.push_back(std::move(trouble));
  }
  return look;
}

// One loop of few positions, counterclockwise, that meets itself nowhere.
bool is_plain_region(std::span<const Loop> loops) {
  constexpr std::size_t few = 16;
  return loops.size() == 1 && loops[0].size() >= 3 && loops[0].size() <= few &&
         !has_touching(loops) && !has_crossing_lines(loops[0]) && !has_spike(loops[0]) &&
         is_counterclockwise(loops[0]);
}

}  // namespace

RegionLook look_at_region(const std::vector<Loop>& loops, const SharedLines& shared) {
  if (shared.is_empty() && is_plain_region(loops)) return look_at_loops(loops);
  std::vector<DirectedLine> sides;
  for (const Loop& loop : loops) shared.append_sides(loop, sides);
  const std::size_t num_sides = sides.size();
  cancel_opposite(sides);
  RegionLook look;
  if (sides.empty()) return look;
  look.troubles = troubles_of(sides);
  if (!look.troubles.empty()) return look;
  if (shared.is_empty() && sides.size() == num_sides && !has_touching(loops))
    return look_at_loops(loops);
  for (const SideWedge& wedge : unpaired_sides(sides)) {
    look.troubles.push_back({wedge.is_paired ? TroubleKind::beside : TroubleKind::unpaired,
                             wedge.at, wedge.first, wedge.at, wedge.second});
  }
  if (!look.troubles.empty()) return look;
  return look_at_loops(traced_loops(sides));
}

bool is_in_trouble(const std::vector<Loop>& loops) {
  return !look_at_region(loops, SharedLines()).troubles.empty();
}

}  // namespace rondel::map
