// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds what keeps the loops of a region from being valid polygons, by exact signs.
#pragma once

#include <cstdint>
#include <vector>

#include "map/planar_loops.h"
#include "map/shared_lines.h"

namespace rondel::map {

// One defect of a region's loops.
struct Trouble {
  enum class TroubleKind : std::uint8_t {
    touching,  // the position c is on the line from a to b
    crossing,  // the lines from a to b and from c to d cross
    // The lines from a to b and from a to d (c equals a) are neighbors around a and have the region
    // on the same side.
    unpaired,
    // The lines from a to b and from a to d (c equals a) are neighbors around a, where other lines
    // are unpaired; these two have the region between them, or outside of both.
    beside,
    turned,  // `loop` is misplaced: it has the region on the wrong side
  };
  TroubleKind kind;
  LonLat a{};
  LonLat b{};
  LonLat c{};
  LonLat d{};
  Loop loop{};
};

// The polygons of a region if it has no trouble. If its only troubles are turned loops, the
// polygons of its other loops.
struct RegionLook {
  std::vector<PolygonWithHoles> polygons;
  std::vector<Trouble> troubles;
};

// The findings of the last look_at_region(): the region's sides in order, and where they met. Pairs
// of unchanged sides are not compared again.
struct RegionMemory {
  std::vector<DirectedLine> sides;
  std::vector<Trouble> meetings;
  bool are_sorted = false;  // the sides; most regions have no troubles and are not looked at again
};

// Returns the polygons or the troubles of a region whose loops are drawn with the divisions and
// merges of `shared`.
RegionLook look_at_region(const std::vector<Loop>& loops, const SharedLines& shared,
                          RegionMemory& memory, unsigned threads = 1);

// True if the loops, as they are, have any trouble.
bool is_in_trouble(const std::vector<Loop>& loops);

}  // namespace rondel::map
