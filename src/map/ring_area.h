// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The signed area of rings of arcs.
//
// in    rings of unit vectors
// out   steradians
#pragma once

#include <span>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::map {

// Returns the area to the left of a ring, from -2 pi to 2 pi, as the sum of triangles (van
// Oosterom, Strackee 1983). For a small ring the triangles are at its first point, and the sign is
// right however thin the ring is. For a large ring they are at its center of mass, or at another
// point whose antipode is no corner.
RONDEL_API double area_on_left(std::span<const Point> ring);

// True if area_on_left() is less than 0. If all triangles turn the same way, no angle is computed.
RONDEL_API bool is_clockwise(std::span<const Point> ring);

// True only if the size of area_on_left() is at least `area`. The test computes no angle and needs
// triangles that all turn the same way; false says nothing.
RONDEL_API bool is_surely_larger(std::span<const Point> ring, double area);

}  // namespace rondel::map
