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

#include "map/polygon_features.h"
#include "rondel/io.h"

namespace rondel::io {

// Which geometries are read; others are errors.
enum class FeatureKinds : std::uint8_t { polygons, all };

// What becomes of rings that are not closed or have less than four positions.
enum class FaultyRings : std::uint8_t {
  error,
  keep,  // LonLatRing::fault says what is wrong with them
};

// Reads Polygons and MultiPolygons, alone or in collections, or all kinds of geometries. A feature
// without a place has no rings. Throws FileError with the line of the first geometry that is not
// valid.
map::PolygonFeatures read_polygon_features(const FileName& file, FeatureKinds kinds,
                                           FaultyRings faulty = FaultyRings::error);

}  // namespace rondel::io
