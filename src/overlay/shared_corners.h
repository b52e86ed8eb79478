// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Neighbors whose border has a corner in one of them alone.
#pragma once

#include <vector>

#include "io/geojson_polygons.h"

namespace rondel::overlay {

// Where a corner of one feature lies on a side of another one, but for rounding, or on one of its own whole turns away,
// that side gets it: lines become straight but for rounding, and neighbors have the same corners. Sides stay straight
// in longitude and latitude.
void share_corners(std::vector<std::vector<io::LonLatRing>>& features, unsigned threads);

}  // namespace rondel::overlay
