// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Determines the inside of the polygons of one feature in the plane of longitude and latitude, by
// exact signs.
//
// in    rings of one feature: shells and their holes
// out   the sides of the border, or the first fault
// index rings, as given
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "map/polygon_features.h"
#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

// A straight side with the inside to its left.
using PlaneSide = LonLatSide;

// The kinds of invalid polygons.
enum class PlaneFaultKind : std::uint8_t {
  crossing,  // sides of two rings cross, or two sides of one ring
  overlap,   // the second ring's polygon lies in the polygon of the first ring
  // The second ring is a hole. Either it lies in another hole, which is the first ring; or it does
  // not lie in its shell, and the first ring is one of another polygon around the place, or
  // no_index.
  outside,
  no_area,  // all sides of the ring cancel
  filled,   // the holes of the ring, a shell, leave nothing of it
};

// An invalid place of the rings.
struct PlaneFault {
  PlaneFaultKind kind;
  Index first;
  Index second;
  LonLat place;
};

// The border of the union of the polygons.
struct PlaneRegion {
  std::vector<PlaneSide> sides;
  std::optional<PlaneFault> fault;  // the westernmost fault; then there are no sides
};

// Returns the region of the polygons, given as rings: for each polygon its shell, then its holes.
//
// 1. A polygon is read by the even-odd rule: sides that occur twice in it cancel, and a ring may
//    meet itself and other rings in points. A hole may share sides with its shell or with another
//    hole.
// 2. Corners that lie on a side, exactly, divide it.
// 3. Polygons may share sides, which cancel, but no area.
// 4. Rings that are left out (LonLatRing::is_left_out) bound nothing. They are counted all the
//    same, so that the other rings keep their indices.
PlaneRegion sweep_rings(std::span<const map::LonLatRing> rings);

}  // namespace rondel::overlay
