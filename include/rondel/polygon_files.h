// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Polygons of files as cells: countries, land, catchments (target rondel::remap).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
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

/// The treatment of features that overlap, contain or repeat each other by more than rounding.
enum class PolygonOverlap : std::uint8_t {
  keep,   ///< cells overlap as they do
  error,  ///< a FileError names two of them, and a place
  first,  ///< what is in several belongs to the first of them
};

/// Whether a feature, with this number and the properties of all features, is taken.
using FeatureChoice = std::function<bool(std::size_t feature, std::span<const Column> columns)>;

struct PolygonOptions {
  PolygonEdges edges = PolygonEdges::lonlat;
  /// How far arcs may be from straight lines in longitude and latitude, which get more corners until they
  /// are so near: degrees. The lines of a feature get more until its area is within 1/1000 of that between the lines, or within
  /// 10 times a tolerance of less than 1e-4.
  double tolerance_deg = 1e-4;
  PolygonOverlap overlap = PolygonOverlap::keep;
  /// Features that are not taken take no space: their cells are empty. Without a choice all are taken.
  FeatureChoice is_taken = {};
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
/// 1. A feature without a place is a cell without rings. One that covers the sphere (-180 -90 180 90, or parts
///    that have all of their sides in common) has none either, and `cells.whole` names it.
/// 2. Straight lines in longitude and latitude mean the plane of these coordinates: a place is inside of a polygon if it lies in it
///    there, by exact signs. Arcs get so many corners that they cross and touch no more than the lines do, however thin a
///    polygon is.
/// 3. A polygon is read even-odd: rings may go either way around. Lines that run to and fro in it vanish, and rings
///    may meet in points, themselves too. Parts of a feature may share sides.
/// 4. Positions on one place of the sphere are one corner: longitudes 180 and -180, and all at a pole. Sides of one
///    feature that run to and fro between the same two corners vanish, so what a file has cut at
///    the antimeridian or led around a pole is whole again.
/// 5. If sides are geodesic, a ring is around its smaller side, and may go around a pole. In straight lines it may not:
///    it has to be led to the pole along the edge of the map. So a ring on one side of the equator whose only side of more than
///    180 degrees of longitude is neither at the pole nor between two meridians is refused: divide the side by a position if it is meant.
/// 6. Features that share a line of positions share the corners that it gets, bit by bit. A corner of one feature that lies
///    on a side of another, but for some roundings (2^-42 degrees), becomes a corner of that, too.
/// \throws FileError for what cannot be read, with file, line and feature; for sides that cross, holes outside of their
///         shell or in another hole, parts that overlap, rings without an area, holes that leave nothing, with feature, ring and place; for
///         features that overlap if options say so.
/// \throws InvalidInput if the tolerance is not positive.
RONDEL_API PolygonTable read_polygons(const FileName& file, const PolygonOptions& options = {},
                                      const Execution& execution = {});

/// A feature for messages: its number, and its property `name` if it has one, "14 (Sudan)".
RONDEL_API std::string feature_name(std::span<const Column> columns, std::size_t feature);

}  // namespace rondel
