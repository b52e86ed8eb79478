// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Set operations on points, lines and polygons together: lines clipped by polygons, points in
/// polygons, lines divided where they cross, and the lines and points in which polygons touch
/// (target rondel::geo). For polygons alone see rondel/set_operations.h.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/feature_cells.h"
#include "rondel/io.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "rondel/set_operations.h"
#include "rondel/types.h"

namespace rondel {

/// Geometries of points, lines and polygons. Geometry i has the places of all of its parts: group i
/// of `lines`, in which a line of one point is that point, and cell i of `polygons`.
struct Geometries {
  FeatureLines lines;
  CellRings polygons;  ///< as many cells as `lines` has groups

  [[nodiscard]] std::size_t size() const { return lines.size(); }
};

/// Reads features of one or several files, whose places are to be compared: those of .geojson or
/// .json as read_polygons() does, with points, lines and collections of them as well, and sites of
/// other formats (read_sites(), read_netcdf_sites()), each of which is a point; "-" is standard
/// input as for read_sites(). Operands of combine() and relate() are the lines and the polygons of
/// the tables.
///
/// Straight lines in longitude and latitude of all files are divided into arcs together. What meets
/// there meets on the sphere: a line along the border of a polygon stays on it, and a point on a
/// line or a side, up to 2^-42 degrees, is a point of it. A line across the antimeridian is cut
/// there, or has longitudes beyond 180; one whose neighboring positions differ by more than 180
/// degrees of longitude is refused, or goes the shorter way if options repair.
/// \return the table of each file
/// \throws what read_polygons() throws, for lines, too; FileError for geodesic lines that lead to
///         the opposite place; InvalidInput if options forbid overlaps
RONDEL_API std::vector<FeatureTable> read_features_together(std::span<const FileName> files,
                                                            const PolygonOptions& options = {},
                                                            const Execution& execution = {});

/// Points, lines and polygons as other programs have them. Feature i has the lines of group i and
/// the polygons of feature i. A line of one position is a point.
struct LonLatGeometries {
  RowGroups<CompressedRows<LonLat>> lines;
  LonLatMultiPolygons polygons;  ///< as many features as `lines` has groups

  [[nodiscard]] std::size_t size() const { return lines.size(); }
};

/// Converts geometries in memory as read_features_together() does those of files.
/// \return the table of each set
/// \throws InvalidInput (the feature, counted over all sets) where that function throws FileError;
///         if offsets or numbers do not fit
RONDEL_API std::vector<FeatureTable> features_of_geometries(std::span<const LonLatGeometries> sets,
                                                            const PolygonOptions& options = {},
                                                            const Execution& execution = {});

/// Computes a set operation on two sets of geometries, each of which counts as its union.
///
/// Polygons are closed, so that their boundary belongs to them, and lines have their ends. A result
/// is closed, too. It has
/// 1. the polygon that combine() returns for the polygons of both operands, with corners where
///    lines meet its sides;
/// 2. lines: what fits to the operation of lines and of polygons' sides, and is not in the polygon
///    of 1. So the intersection of a line and a polygon has the pieces of the line along the
///    polygon's side, and the difference has not; and two polygons that touch in a side have this
///    side in common;
/// 3. points, likewise, that are not in the polygon and on no line of 2.
///
/// Lines of a result meet in their ends alone. They end where one edge or more than two edges of
/// the result meet, and go on elsewhere, also where a line of an operand ends: as after
/// shapely.line_merge(shapely.union_all(...)). A line has the direction of the lines of A along it,
/// or else of B; where these disagree, that of the larger number of edges, or from the end that is
/// lower in the spatial order. A closed line has its first point at its end again.
///
/// Which places lie on a line or in a polygon is exact. All arcs are arranged together
/// (rondel/arrangement.h): points of lines and corners stay bit by bit, places where arcs cross are
/// rounded to doubles, and no two arcs of a result cross after that. The result depends on the two
/// sets of places and directions alone, not on the order of geometries, lines and points, nor on
/// the number of threads. An operation on results finds the same places again.
/// \param first, second  A and B; points as arrange() wants them
/// \return one geometry
/// \throws InvalidInput if offsets do not fit or the numbers of groups and cells differ; (the
///         position of the geometry, those of B after those of A) if a line has no point, or leads
///         to the opposite point, up to 2^-45, or a point is no unit vector; or as combine() for
///         polygons
RONDEL_API Geometries combine(const Geometries& first, const Geometries& second,
                              SetOperation operation, const Execution& execution = {});

/// Computes the union of all geometries: combine() with no second operand. Lines are divided where
/// they cross, and what occurs twice is there once.
RONDEL_API Geometries unite(const Geometries& geometries, const Execution& execution = {});

/// Computes a set operation on pairs of geometries, each pair by itself: geometry k of the result
/// is that of `pairs[k][0]` of A and `pairs[k][1]` of B.
/// \throws InvalidInput if offsets do not fit, or (the position of the pair) if a geometry does not
///         exist or is one that combine() refuses
RONDEL_API Geometries combine_pairs(const Geometries& first, const Geometries& second,
                                    std::span<const std::array<Index, 2>> pairs,
                                    SetOperation operation, const Execution& execution = {});

/// Pieces of geometries: piece k is of geometry `first[k]` of A and `second[k]` of B, no_index for
/// none.
struct GeometryPieces {
  Geometries pieces;
  std::vector<Index> first;
  std::vector<Index> second;
};

/// Divides two sets of geometries by each other, as overlay_pieces() divides polygons: into what a
/// geometry of A and one of B have in common, and what is in none of the other set. Each piece has
/// polygons, lines and points as the result of combine(). A place of several geometries of one set
/// is in several pieces, such as a line along the border of two polygons.
/// \return pieces sorted by both geometries
/// \throws InvalidInput as combine()
RONDEL_API GeometryPieces overlay_pieces(const Geometries& first, const Geometries& second,
                                         SetOperation operation, const Execution& execution = {});

/// Removes from the pieces of two sets of geometries the parts in which geometries only touch or
/// cross: those of fewer dimensions than both geometries of the piece have, such as the point in
/// which a river touches a border, or the line that two countries have in common. The dimension of
/// a geometry is that of its lowest part: 0 for points, 1 for lines, 2 for polygons.
/// \return the pieces that have a place left
/// \throws InvalidInput if arrays do not fit
RONDEL_API GeometryPieces without_touching_parts(const GeometryPieces& pieces,
                                                 const Geometries& first, const Geometries& second);

/// Removes such parts from what combine() returns for two sets of geometries: those of fewer
/// dimensions than the lowest part of both sets has.
RONDEL_API Geometries without_touching_parts(const Geometries& combined, const Geometries& first,
                                             const Geometries& second);

/// Lines and points in longitude and latitude.
struct LonLatLines {
  CompressedRows<LonLat> parts;  ///< a part of one position is a point
  std::vector<Index> owners;     ///< the feature of each part, never decreasing
};

/// Computes lines within [-180, 180] x [-90, 90], cut at the antimeridian and the poles: the lines
/// of write_geometries().
/// \throws InvalidInput if offsets do not fit, a line has no point, or the tolerance is not
///         positive
RONDEL_API LonLatLines lonlat_lines(const FeatureLines& lines, double tolerance_deg = 0.01,
                                    const Execution& execution = {});

/// Writes geometries, one feature for each: points, lines and polygons in longitude and latitude,
/// cut at the antimeridian and the poles, or a GeometryCollection of them. The geometry of a
/// feature without a place is null; GDAL's formats leave out such a feature. Properties are `area`
/// (steradians) if there are polygons, `length` (radians) if there are lines, and the columns.
/// \param file  as for write_regions(); GDAL writes multiple geometries
/// \param columns, ids  as for write_regions(), one value for each geometry
/// \param tolerance_deg  how far lines may be from their great circles, in degrees
/// \param drawing  of the polygons, as for region_polygons()
/// \throws InvalidInput, FileError as write_regions(); InvalidInput if a line has no point
RONDEL_API void write_geometries(const FileName& file, const Geometries& geometries,
                                 std::span<const Column> columns = {}, double tolerance_deg = 0.01,
                                 const Execution& execution = {}, const Column& ids = {},
                                 CellDrawing drawing = CellDrawing::together);

/// Computes the length of each feature's lines in radians: the sum of the lengths of their arcs. It
/// is 0 for points.
RONDEL_API std::vector<double> lengths(const FeatureLines& lines);

}  // namespace rondel
