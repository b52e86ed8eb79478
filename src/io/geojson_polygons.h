// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads polygons of GeoJSON (RFC 7946) without changing them, and lines and points if these are
// wanted.
//
// in    a file
// out   rings and lines of positions in degrees, and columns of properties
// index features of the file, or bare geometries
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rondel/io.h"
#include "rondel/types.h"

namespace rondel::io {

// A ring as the file has it.
struct LonLatRing {
  std::vector<LonLat> positions;  // degrees; the first position is not repeated
  bool is_hole = false;           // a ring that is not a hole begins a polygon
  bool is_turn =
      false;  // its last position is the first one a whole turn of the globe away, and left out
  // The positions before corners of others were inserted, if the ring is so thin that these may
  // have closed it (overlay/shared_corners.h).
  std::vector<LonLat> thin_positions = {};
  bool is_left_out = false;  // no wider than rounding
};

// Row i belongs to feature i of the file, or to bare geometry i.
struct PolygonFeatures {
  std::string name;  // name of the file for messages
  std::vector<std::vector<LonLatRing>> rings;
  std::vector<std::vector<std::vector<LonLat>>> lines;  // a point is a line of one position
  std::vector<Column> columns;
  Column ids;  // the members `id`, as JSON; without cells if there are none
};

// Which geometries are read; others are errors.
enum class FeatureKinds : std::uint8_t { polygons, all };

// Reads Polygons and MultiPolygons, alone or in collections, or all kinds of geometries. A feature
// without a place has no rings. Throws FileError with the line of the first geometry that is not
// valid.
PolygonFeatures read_polygon_features(const FileName& file, FeatureKinds kinds);

}  // namespace rondel::io
