// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Gives sides that meet at a pole the same corners where they lie on one meridian.
#pragma once

#include <span>

#include "overlay/plane_arcs.h"
#include "overlay/plane_sweep.h"

namespace rondel::overlay {

// An arc to a pole is on the meridian of its other end, so arcs of different lines to a pole lie on
// each other if their last corners have one longitude. Inserts into each such arc the corners of
// other sides that are on it, so that the arcs are equal and not only equal up to rounding.
void share_polar_corners(std::span<const PlaneSide> sides, DividedSides& divided);

}  // namespace rondel::overlay
