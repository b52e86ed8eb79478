// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Polygons of files as cells: countries, land, catchments (target rondel::remap).
#pragma once

#include <string>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/types.h"

namespace rondel {

/// What joins two positions of a file.
enum class PolygonEdges : std::uint8_t {
  lonlat,    ///< a straight line in longitude and latitude (RFC 7946, section 3.1.1)
  geodesic,  ///< the shorter arc of a great circle
};

struct PolygonOptions {
  PolygonEdges edges = PolygonEdges::lonlat;
  /// How far arcs may be from straight lines in longitude and latitude, which get more corners until they
  /// are so near: degrees.
  double tolerance_deg = 1e-4;
};

/// The polygons of a file: cell i is feature i.
struct PolygonTable {
  std::string name;  ///< the file, for messages
  CellRings cells;
  std::vector<Column> columns;  ///< the properties
};

/// Reads .geojson (or .json): Polygon, MultiPolygon, and collections of them, in features or bare. "-" is
/// standard input.
///
/// 1. A feature without a place is a cell without rings.
/// 2. Positions on one place of the sphere are one corner: longitudes 180 and -180, and all at a pole. Sides of one
///    feature that run to and fro between the same two corners vanish, so what a file has cut at
///    the antimeridian or led around a pole is whole again.
/// 3. Outer rings may go either way around, and holes too: the first ring of a polygon is around its
///    inside, in the plane of longitude and latitude or, if sides are geodesic, on its smaller side.
/// 4. Features that share a line of positions share the corners that it gets, bit by bit.
/// \throws FileError for what cannot be read, with file, line and feature.
/// \throws InvalidInput if the tolerance is not positive.
RONDEL_API PolygonTable read_polygons(const FileName& file, const PolygonOptions& options = {},
                                      const Execution& execution = {});

}  // namespace rondel
