// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/settled_regions.h"

#include <cstddef>
#include <utility>

#include "map/planar_faces.h"
#include "map/snap_rounding.h"
#include "system/parallel.h"

namespace rondel::map {
namespace {

// The lines between faces of different regions.
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

}  // namespace

std::vector<std::vector<PolygonWithHoles>> settled_regions(
    std::span<const std::vector<DirectedLine>> sides_of_regions, unsigned threads) {
  constexpr std::size_t grain = 16;
  const std::vector<std::vector<DirectedLine>> borders =
      borders_of(snap_rounded(sides_of_regions), sides_of_regions.size());
  std::vector<std::vector<PolygonWithHoles>> regions(borders.size());
  system::parallel_for(threads, borders.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!borders[i].empty()) regions[i] = polygons_of_loops(traced_loops(borders[i])).polygons;
    }
  });
  return regions;
}

}  // namespace rondel::map
