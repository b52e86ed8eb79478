// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Reading polygons as cells: countries, land, catchments (target rondel::geo).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/types.h"

namespace rondel {

/// The line between two positions of a file.
enum class PolygonEdges : std::uint8_t {
  lonlat,    ///< a straight line in longitude and latitude (RFC 7946, section 3.1.1)
  geodesic,  ///< the shorter arc of a great circle
};

/// Returns the name of a value: "lonlat", "geodesic"; empty for other numbers.
RONDEL_API std::string_view name_of(PolygonEdges edges) noexcept;

/// The treatment of features that overlap, contain or repeat each other by more than rounding.
enum class PolygonOverlap : std::uint8_t {
  keep,   ///< their cells overlap
  error,  ///< a FileError names two of them, and a place in both
  first,  ///< a place in several features belongs to the first of them
};

/// Returns the name of a value: "keep", "error", "first"; empty for other numbers.
RONDEL_API std::string_view name_of(PolygonOverlap overlap) noexcept;

/// The treatment of features that are not valid: sides that cross, rings without an area, holes
/// outside of their shell, parts that overlap, rings around a pole that are not led to it, rings
/// that are not closed.
enum class InvalidPolygons : std::uint8_t {
  error,  ///< a FileError names the feature, what is wrong with it, and a place
  /// The feature is repaired, and a remark says so. Each of its polygons has the places that an odd
  /// number of its rings' sides divides from the outside, and the feature is their union. No
  /// position moves; sides get corners where they cross. Other features stay bit by bit.
  repair,
};

/// Returns the name of a value: "error", "repair"; empty for other numbers.
RONDEL_API std::string_view name_of(InvalidPolygons invalid) noexcept;

/// A function that decides whether a feature is taken, by its index and the properties of all
/// features.
using FeatureChoice = std::function<bool(std::size_t feature, std::span<const Column> columns)>;

struct PolygonOptions {
  PolygonEdges edges = PolygonEdges::lonlat;
  /// How far arcs may be from the straight lines in longitude and latitude that they stand for, in
  /// degrees; the lines get more corners until the arcs are so near. They get further corners until
  /// the area of a feature differs from that between the lines by a share of at most 1/1000, or of
  /// at most 10 times this number if that is less.
  double tolerance_deg = 1e-4;
  InvalidPolygons invalid = InvalidPolygons::error;
  PolygonOverlap overlap = PolygonOverlap::keep;
  /// The features to read. Others are cells without rings, and take no space. Without a function
  /// all are taken.
  FeatureChoice is_taken = {};
};

/// Reads polygons as cells from .geojson or .json, or by GDAL .gpkg, .fgb, .shp and .parquet; cell i is feature i, whose properties are columns: Polygon, MultiPolygon, and collections of them, in
/// features or bare. "-" is standard input.
///
/// 1. A feature without a geometry is a cell without rings. A feature that covers the sphere (-180
///    -90 180 90, or parts that have all of their sides in common) has no rings either, and is in
///    `cells.whole`.
/// 2. Straight lines in longitude and latitude are lines in the plane of these coordinates: a place
///    is inside of a polygon if it is inside in that plane, by exact signs. Arcs get so many
///    corners that they cross and touch only where the lines do, however thin a polygon is.
/// 3. A polygon is read by the even-odd rule: rings may have either direction. Lines that occur
///    twice in it cancel, and rings may meet in points, themselves too. Parts of a feature may
///    share sides.
/// 4. Positions in one place of the sphere are one corner: longitudes 180 and -180, and all
///    longitudes at a pole. Sides of one feature that lead back and forth between the same two
///    corners cancel, so that a polygon that a file has cut at the antimeridian or led around a
///    pole is whole again.
/// 5. If sides are geodesic, a ring is around its smaller side, and may go around a pole. A ring of
///    straight lines may not: it has to be led to the pole along the edge of the map. So a ring on
///    one side of the equator is refused if its only side of more than 180 degrees of longitude is
///    neither at the pole nor between two meridians; divide the side by a position if it is meant.
/// 6. Features that share a line of positions share the corners that it gets, bit by bit. A corner
///    of one feature that lies on a side of another one, up to some roundings (2^-42 degrees),
///    becomes a corner of that one, too. Sides of a feature that cross there cross all the same: no
///    other feature makes it valid.
/// \throws FileError for what cannot be read, with file, line and feature; unless they are to be
///         repaired, for sides that cross, holes outside of their shell or in another hole, parts
///         that overlap, rings without an area, holes that leave nothing, with feature, ring and
///         place; for features that overlap if options say so.
/// \throws InvalidInput if the tolerance is not positive.
RONDEL_API CellTable read_polygons(const FileName& file, const PolygonOptions& options = {},
                                   const Execution& execution = {});

/// Polygons as other programs have them: feature i consists of the polygons `offsets[i] ...
/// offsets[i+1]-1`, each of which has rings, the outer one first. A row has the positions of a ring,
/// whose last one is the first one again.
using LonLatMultiPolygons = RowGroups<RowGroups<CompressedRows<LonLat>>>;

/// Makes polygons into cells as read_polygons() does; cell i is feature i.
/// \throws InvalidInput where read_polygons() throws FileError, with the feature; or if offsets do
///         not fit
RONDEL_API CellTable cells_of_polygons(const LonLatMultiPolygons& features,
                                       const PolygonOptions& options = {},
                                       const Execution& execution = {});

/// Returns the cells of cells_of_polygons() alone. That takes less time where features are repaired,
/// since nobody is told what was wrong with them.
/// \throws InvalidInput as cells_of_polygons() does
RONDEL_API CellRings rings_of_polygons(const LonLatMultiPolygons& features,
                                       const PolygonOptions& options = {},
                                       const Execution& execution = {});

/// Finds out which polygons are not valid, by the rules of read_polygons(). The text of feature i is
/// what is wrong with it, as read_polygons() would say, and empty if it is valid.
/// \throws FileError for what cannot be read
RONDEL_API std::vector<std::string> polygon_faults(const FileName& file,
                                                   const PolygonOptions& options = {},
                                                   const Execution& execution = {});

/// Finds out which polygons in memory are not valid, as for those of a file.
/// \throws InvalidInput (the feature) if a position is no longitude and latitude; if offsets do not fit
RONDEL_API std::vector<std::string> polygon_faults(const LonLatMultiPolygons& features,
                                                   const PolygonOptions& options = {},
                                                   const Execution& execution = {});

/// Returns a feature's name for messages: its index, and its property `name` if it has one, "14
/// (Sudan)".
RONDEL_API std::string feature_name(std::span<const Column> columns, std::size_t feature);

}  // namespace rondel
