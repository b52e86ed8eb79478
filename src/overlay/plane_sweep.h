// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the inside of the polygons of one feature, in the plane of longitude and latitude, by exact signs alone.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "io/geojson_polygons.h"
#include "rondel/types.h"

namespace rondel::overlay {

// A straight line of the plane with the inside to its left.
struct PlaneSide {
  LonLat from;
  LonLat to;
};

enum class PlaneFaultKind : std::uint8_t {
  crossing,  // sides of both rings cross, or of one with itself
  overlap,   // the second ring's polygon lies in that of the first one
  outside,  // the second ring is a hole that does not lie in its shell, or lies in the first one, a hole, too
  no_area,  // the ring is a line to and fro
};

// A fault of the rings, and its place. Rings are numbered as they were given.
struct PlaneFault {
  PlaneFaultKind kind;
  Index first;
  Index second;
  LonLat place;
};

// The border of what lies in any of the polygons: first of each the shell, then its holes.
struct PlaneRegion {
  std::vector<PlaneSide> sides;
  std::optional<PlaneFault> fault;  // the first one from the west; there are no sides then
};

// 1. A polygon is read even-odd: lines that run to and fro in it vanish, and a ring may meet itself and others in points.
// 2. Corners that lie on a side, exactly, divide it.
// 3. Polygons may share sides, which vanish, but no area.
PlaneRegion sweep_rings(std::span<const io::LonLatRing> rings);

}  // namespace rondel::overlay
