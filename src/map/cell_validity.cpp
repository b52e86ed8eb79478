// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells that are no polygons in the plane: CellMap's item 5.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "map/cell_map.h"
#include "map/line_troubles.h"
#include "map/map_plane.h"
#include "map/rectangles.h"
#include "map/settled_regions.h"
#include "system/parallel.h"

namespace rondel::map {
namespace {

constexpr std::size_t cells_per_piece = 1024;

Rectangle rectangle_of(const Loop& ring) {
  Rectangle around{180, -180, 90, -90};
  for (const LonLat& p : ring) {
    around.west = std::min(around.west, p.lon_deg);
    around.east = std::max(around.east, p.lon_deg);
    around.south = std::min(around.south, p.lat_deg);
    around.north = std::max(around.north, p.lat_deg);
  }
  return around;
}

bool is_inside_ring(const Loop& closed, const LonLat& p) {
  bool is_inside = false;
  for (std::size_t k = 0; k + 1 < closed.size(); ++k) {
    const LonLat& a = closed[k];
    const LonLat& b = closed[k + 1];
    if ((a.lon_deg > p.lon_deg) == (b.lon_deg > p.lon_deg)) continue;
    const Sign side = b.lon_deg > a.lon_deg ? side_of_line(a, b, p) : side_of_line(b, a, p);
    is_inside = is_inside != (side == Sign::positive);
  }
  return is_inside;
}

// Whether a polygon that does not cross a hole, and lies not in what the hole is cut from, fills a part of it.
bool is_in_hole(const Loop& hole, const Loop& ring) {
  const Rectangle room = rectangle_of(hole);
  const Rectangle around = rectangle_of(ring);
  if (around.west < room.west || around.east > room.east || around.south < room.south ||
      around.north > room.north)
    return false;
  for (const LonLat& p : ring) {
    if (std::ranges::find(hole, p) == hole.end()) return is_inside_ring(hole, p);
  }
  return true;
}

// A convex cell has no holes but of rounding: they become parts of it, and what is in them goes.
void fill_holes(std::vector<std::vector<PolygonWithHoles>>& cells) {
  std::vector<Loop> holes;
  for (auto& cell : cells) {
    for (PolygonWithHoles& polygon : cell) {
      for (std::size_t k = 1; k < polygon.rings.size(); ++k)
        holes.push_back(std::move(polygon.rings[k]));
      polygon.rings.resize(1);
    }
  }
  for (const Loop& hole : holes) {
    for (auto& cell : cells) {
      std::erase_if(cell, [&](const PolygonWithHoles& polygon) {
        return is_in_hole(hole, polygon.rings.front());
      });
    }
  }
}

}  // namespace

bool CellMap::has_invalid(const Execution& execution) const {
  if (only_vertex_ < sites_.size()) return false;
  const SharedLines unchanged;
  std::atomic<bool> found{false};
  system::parallel_for(execution.threads, sites_.size(), cells_per_piece,
                       [&](std::size_t begin, std::size_t end) {
                         Pen pen;
                         for (std::size_t site = begin; site < end && !found; ++site) {
                           if (!has_cell(site) || is_unchanged(site)) continue;
                           std::vector<Loop> loops;
                           for (const LonLatPolygon& polygon : polygons(site, pen))
                             loops.emplace_back(polygon.ring.begin(), polygon.ring.end() - 1);
                           if (!look_at_region(loops, unchanged).troubles.empty()) found = true;
                         }
                       });
  return found;
}

std::vector<DirectedLine> CellMap::sides_of(std::size_t site, Pen& pen) const {
  std::vector<Loop> loops;
  if (is_unchanged(site)) {
    loops.emplace_back();
    for (const Index point : points_of(site)) loops.back().push_back(positions_[point]);
  } else if (draw_ring(site, pen.ring_, pen.trace_)) {
    loops = drawn_loops(pen.trace_);
  }
  std::vector<DirectedLine> sides;
  for (const Loop& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k)
      sides.push_back({loop[k], loop[k + 1 < loop.size() ? k + 1 : 0]});
  }
  return sides;
}

void CellMap::settle(const Execution& execution) {
  std::vector<std::vector<DirectedLine>> sides(sites_.size());
  system::parallel_for(execution.threads, sites_.size(), cells_per_piece,
                       [&](std::size_t begin, std::size_t end) {
                         Pen pen;
                         for (std::size_t site = begin; site < end; ++site) {
                           if (has_cell(site)) sides[site] = sides_of(site, pen);
                         }
                       });
  std::vector<std::vector<PolygonWithHoles>> cells = settled_regions(sides, execution.threads);
  fill_holes(cells);
  settled_.resize(cells.size());
  for (std::size_t site = 0; site < cells.size(); ++site) {
    for (PolygonWithHoles& polygon : cells[site])
      settled_[site].push_back({std::move(polygon.rings.front())});
  }
}

}  // namespace rondel::map
