// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons of GeoJSON (RFC 7946) as the file has them, and lines and points where these are wanted.
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
  bool is_hole = false;           // a ring that is no hole begins a polygon
  bool is_turn =
      false;  // its last position is the first one a whole turn of the globe away, and left out
};

// Row i is feature i of the file, or bare geometry i.
struct PolygonFeatures {
  std::string name;  // of the file, for messages
  std::vector<std::vector<LonLatRing>> rings;
  std::vector<std::vector<std::vector<LonLat>>> lines;  // a point is a line of one position
  std::vector<Column> columns;
};

enum class FeatureKinds : std::uint8_t { polygons, all };

// Polygons, MultiPolygons, and collections of those, or of all kinds. A feature without a place has no rings.
// Throws FileError.
RONDEL_API PolygonFeatures read_polygon_features(const FileName& file, FeatureKinds kinds);

}  // namespace rondel::io
