// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Messages about invalid polygons of a file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "map/polygon_features.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Returns "longitude latitude" in degrees, with 10 significant digits.
std::string text_of_place(const LonLat& place);
std::string text_of_place(const Point& place);

// Returns a name for a ring of a feature, such as "ring 0 of part 2" for the shell of the third
// polygon.
std::string ring_name(const std::vector<map::LonLatRing>& rings, Index ring);

// Throws FileError with the name of the file, the feature and what is wrong with it.
[[noreturn]] void refuse_feature(const map::PolygonFeatures& features, std::size_t feature,
                                 const std::string& what);

}  // namespace rondel::overlay
