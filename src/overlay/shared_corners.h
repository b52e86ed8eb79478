// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Neighbors whose border has a corner in one of them alone.
#pragma once

#include <vector>

#include "io/geojson_polygons.h"

namespace rondel::overlay {

// A side gets the corners of other features that lie on it, but for rounding, and those of its own feature whole turns away. Then lines
// are straight but for rounding, and neighbors have the same corners. Sides stay straight in longitude and latitude.
void share_corners(std::vector<std::vector<io::LonLatRing>>& features, unsigned threads);

}  // namespace rondel::overlay
