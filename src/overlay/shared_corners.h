// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Adds corners to neighboring features where only one of them has a corner on their common border.
#pragma once

#include <vector>

#include "map/polygon_features.h"

namespace rondel::overlay {

// Inserts corners into sides: those of other features that lie on the side up to rounding, and
// those of the same feature that lie there after a shift by 360 degrees. Sides are then straight
// only up to rounding, and neighbors have the same corners. Rings that may run to and fro after
// that keep the positions that they had as `thin_positions`.
void share_corners(std::vector<std::vector<map::LonLatRing>>& features, unsigned threads);

}  // namespace rondel::overlay
