// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Features as they are written to files.
//
// in    points, lines and polygons in degrees; numbers and columns
// index features; row i of a column belongs to feature i
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "map/valid_regions.h"
#include "rondel/io.h"
#include "rondel/types.h"

namespace rondel::formats {

// The kinds of parts that a geometry may have, in the order in which they are written.
enum class PartKind : std::uint8_t { point, line, polygon };

// A geometry in degrees of longitude and latitude. One without parts is null.
struct DrawnGeometry {
  std::vector<LonLat> points;
  std::vector<std::vector<LonLat>> lines;
  map::PolygonsOfRegion polygons;

  // Returns the number of parts of a kind.
  [[nodiscard]] std::size_t num_parts(PartKind kind) const {
    return std::array{points.size(), lines.size(), polygons.size()}.at(
        static_cast<std::size_t>(kind));
  }
  [[nodiscard]] bool is_empty() const {
    return points.empty() && lines.empty() && polygons.empty();
  }
};

// A number for each feature that is computed from its geometry, and its name.
struct Measure {
  const char* name;
  std::vector<double> values;
};

struct DrawnFeatures {
  std::vector<DrawnGeometry> geometries;
  std::vector<bool> is_written;  // whether a feature is written; one that is has a place
  std::vector<Measure> measures;
  std::span<const Column> columns;
  const Column& ids;
  // True if each geometry is one point, which files of GDAL then have as a Point, not a MultiPoint.
  bool are_single_points = false;
};

}  // namespace rondel::formats
