// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What keeps the loops of a region from being polygons; by exact signs.
#pragma once

#include <cstdint>
#include <vector>

#include "map/planar_loops.h"
#include "map/shared_lines.h"

namespace rondel::map {

struct Trouble {
  enum class TroubleKind : std::uint8_t {
    touching,  // c is on the line from a to b
    crossing,  // the lines from a to b and from c to d cross
    unpaired,  // lines from a to b and from a to d (c is a) are next to each other, with the region on the same side
    beside,  // the same, at a position with unpaired lines, but of these with the region between them or outside
    turned,  // `loop` has the region on its wrong side
  };
  TroubleKind kind;
  LonLat a{};
  LonLat b{};
  LonLat c{};
  LonLat d{};
  Loop loop{};
};

// The polygons of a region, if there is no trouble; beside loops that are turned, those of its other loops.
struct RegionLook {
  std::vector<PolygonWithHoles> polygons;
  std::vector<Trouble> troubles;
};

// The sides of a region when it was looked at, in order, and where they met: what is the same is not compared again.
struct RegionMemory {
  std::vector<DirectedLine> sides;
  std::vector<Trouble> meetings;
};

RegionLook look_at_region(const std::vector<Loop>& loops, const SharedLines& shared,
                          RegionMemory& memory);

// Whether loops as they are have any trouble.
bool is_in_trouble(const std::vector<Loop>& loops);

}  // namespace rondel::map
