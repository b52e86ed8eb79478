// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/settled_regions.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "map/map_plane.h"
#include "map/planar_faces.h"
#include "map/rectangles.h"
#include "map/snap_rounding.h"
#include "system/parallel.h"

namespace rondel::map {
namespace {

// Returns for each region the lines between its faces and those of other regions.
std::vector<std::vector<DirectedLine>> borders_of(std::span<const NodedLine> lines,
                                                  std::size_t num_regions) {
  const PlanarFaces faces(lines);
  std::vector<std::vector<DirectedLine>> borders(num_regions);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t left = faces.region_at(2 * i);
    const std::size_t right = faces.region_at(2 * i + 1);
    if (left == right) continue;
    if (left != no_region) borders[left].push_back({lines[i].from, lines[i].to});
    if (right != no_region) borders[right].push_back({lines[i].to, lines[i].from});
  }
  return borders;
}

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

// True if a position that is on no side of a closed ring is inside of it: an odd number of sides is
// above it, and so is an odd number below it.
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

// True if a ring, which does not cross the hole and is not outside of the polygon with the hole,
// lies in the hole.
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

// Removes all holes of the polygons and the polygons that lie in these holes.
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

std::vector<std::vector<PolygonWithHoles>> settled_regions(
    std::span<const std::vector<DirectedLine>> sides_of_regions, unsigned threads) {
  constexpr std::size_t grain = 16;
  const std::vector<std::vector<DirectedLine>> borders =
      borders_of(snap_rounded(sides_of_regions), sides_of_regions.size());
  std::vector<std::vector<PolygonWithHoles>> regions(borders.size());
  system::parallel_for(threads, borders.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!borders[i].empty())
        regions[i] = polygons_of_loops(traced_loops(borders[i]), threads).polygons;
    }
  });
  return regions;
}

std::vector<std::vector<LonLatPolygon>> settled_convex_regions(
    std::span<const std::vector<DirectedLine>> sides_of_regions, unsigned threads) {
  std::vector<std::vector<PolygonWithHoles>> regions = settled_regions(sides_of_regions, threads);
  fill_holes(regions);
  std::vector<std::vector<LonLatPolygon>> polygons(regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i) {
    for (PolygonWithHoles& polygon : regions[i])
      polygons[i].push_back({std::move(polygon.rings.front())});
  }
  return polygons;
}

std::vector<DirectedLine> sides_of_loops(std::span<const Loop> loops) {
  std::vector<DirectedLine> sides;
  for (const Loop& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k)
      sides.push_back({loop[k], loop[k + 1 < loop.size() ? k + 1 : 0]});
  }
  return sides;
}

}  // namespace rondel::map
