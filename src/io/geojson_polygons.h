// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons of GeoJSON (RFC 7946) as the file has them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/types.h"

namespace rondel::io {

struct LonLatRing {
  std::vector<LonLat> positions;  // degrees; the first one is not repeated
  bool is_hole = false;
};

// Row i is feature i of the file, or bare geometry i.
struct PolygonFeatures {
  std::string name;  // of the file, for messages
  std::vector<std::vector<LonLatRing>> rings;
  std::vector<std::uint64_t> lines;
  std::vector<Column> columns;
};

// Polygons, MultiPolygons, and collections of those. A feature without a place has no rings.
// Throws FileError.
RONDEL_API PolygonFeatures read_polygon_features(const FileName& file);

}  // namespace rondel::io
