// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The signed area of rings of arcs.
//
// in    rings of unit vectors
// out   steradians
#pragma once

#include <span>

#include "exact/eft.h"
#include "rondel/types.h"

namespace rondel::map {

// Returns the area to the left of a ring, from -2 pi to 2 pi, as the sum of triangles (van
// Oosterom, Strackee 1983). For a small ring the triangles are at its first point, and the sign is
// right however thin the ring is. For a large ring they are at its center of mass, or at another
// point whose antipode is no corner. A ring without corners has no area.
double area_on_left(std::span<const Point> ring);

// Returns the sum of area_on_left() of all rings of a region, which is its area but for a multiple of 4 pi. It is taken in
// twice the precision, as rings may cancel each other.
template <class Rings>
[[nodiscard]] double areas_on_left(const Rings& rings) {
  exact::DoubleDouble sum{};
  for (const auto& ring : rings) add_term(area_on_left(ring), sum);
  return sum.hi + sum.lo;
}

// True if the rings of a region that are small together have all that is outside of them on their left: a
// region that is on the outside of its rings is the whole sphere where these vanish.
template <class Rings>
[[nodiscard]] bool have_outside_on_left(const Rings& rings) {
  return areas_on_left(rings) < 0;
}

// True if area_on_left() is less than 0. If all triangles turn the same way, no angle is computed.
bool is_clockwise(std::span<const Point> ring);

// True only if the size of area_on_left() is at least `area`. The test computes no angle;
// false says nothing. A ring of few corners needs triangles that all turn the same way, and one of
// many has to be in a cap of 18 degrees.
bool is_surely_larger(std::span<const Point> ring, double area);

}  // namespace rondel::map
