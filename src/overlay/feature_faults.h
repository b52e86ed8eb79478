// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Words for what is wrong with the polygons of a file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/geojson_polygons.h"
#include "rondel/types.h"

namespace rondel::overlay {

std::string text_of_place(const LonLat& place);
std::string text_of_place(const Point& place);

// "ring 0 of part 2": the shell of the third polygon.
std::string ring_name(const std::vector<io::LonLatRing>& rings, Index ring);

// Throws FileError with the file and the feature.
[[noreturn]] void refuse_feature(const io::PolygonFeatures& features, std::size_t feature,
                                 const std::string& what);

}  // namespace rondel::overlay
