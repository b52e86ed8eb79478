// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::map {

// The area to the left of a ring (Oosterom, Strackee 1983), from -2 pi to 2 pi, by triangles at its first point:
// of a small ring it has the right sign however thin the ring is. Of a large one they are triangles at its center of
// mass, or at another point whose antipode is no corner.
RONDEL_API double area_on_left(std::span<const Point> ring);

// Whether area_on_left() is less than 0. Triangles that all turn one way tell without an angle.
RONDEL_API bool is_clockwise(std::span<const Point> ring);

// Whether that is at least so much to the right or to the left, where triangles that all turn one way tell without an
// angle; false says nothing.
RONDEL_API bool is_surely_larger(std::span<const Point> ring, double area);

}  // namespace rondel::map
