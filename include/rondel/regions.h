// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Operations on cells and regions: intersection, clipping, dissolving, areas, overlaps, and
/// polygons for maps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/cell_set.h"
#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/polygon_files.h"
#include "rondel/types.h"

namespace rondel {

/// The intersections of cells with regions. Piece k is that of cell `cells[k]` and region
/// `regions[k]`; pieces are sorted by both.
struct RegionPieces {
  /// Piece k is cell k of `rings`.
  CellRings rings;
  std::vector<Index> cells;
  std::vector<Index> regions;

  [[nodiscard]] std::size_t num_pieces() const { return cells.size(); }
};

/// Computes the intersections of cells with regions, as polygons.
///
/// 1. Which edges cross is decided as by remap(); corners where they cross are rounded.
/// 2. Rings are simple, and two rings meet at most in points; a ring begins at its corner with the
///    least coordinates. Where two pieces meet, both have the same corners, bit by bit.
/// 3. Rings whose area is no larger than rounding are left out.
/// 4. A piece that is the whole sphere has no border, and so no rings: it is in `rings.whole`.
/// 5. The result depends on the cells and their order alone, not on the number of threads.
///
/// If neither set of cells covers_sphere(), one of them is completed to a cover as by remap(),
/// which takes longer: sides of its cells get corners where corners of its other cells, or the ends
/// of the coordinate axes, lie on them.
/// \throws InvalidInput if cells are a grid of parallels, a cell crosses or overlaps itself,
///         or neither covers_sphere() and cells of both overlap, with two of each.
RONDEL_API RegionPieces intersection(const CellSet& cells, const CellSet& regions,
                                     const Execution& execution = {});

/// Computes the part of each cell that lies in any of the regions: the pieces of intersection(),
/// joined by cell. A cell of which nothing is left has no rings; a cell of which the whole sphere
/// is left is in `whole`. Regions that overlap are united first. Regions that share a border must
/// have the same corners along it; otherwise the border stays visible.
/// \throws InvalidInput as intersection().
RONDEL_API CellRings clip(const CellSet& cells, const CellSet& regions,
                          const Execution& execution = {});

/// Joins cells by group: cell i becomes a part of `groups[i]`, or of no group if that is no_index.
/// Edges that two cells of one group have in common are removed; edges between groups are the same
/// for both, bit by bit. A group that covers the sphere has no border, and so no rings: it is in
/// `whole`.
/// \throws InvalidInput if there is not one group for each cell, or one is neither below num_groups
///         nor no_index (its index).
RONDEL_API CellRings dissolve(const CellRings& cells, std::span<const Index> groups,
                              std::size_t num_groups, const Execution& execution = {});

/// Joins pieces: those of the same group of cells and the same group of regions become one, as
/// dissolve() joins cells. Pieces in no group (no_index) are left out. Without groups each cell, or
/// each region, is a group.
/// \return the joined pieces, sorted by both groups, of which `cells` and `regions` have the
///         indices
/// \throws InvalidInput if a cell or region has no group
RONDEL_API RegionPieces dissolve(const RegionPieces& pieces, std::span<const Index> cell_groups,
                                 std::span<const Index> region_groups,
                                 const Execution& execution = {});

/// Two cells that cross or overlap, or a cell that crosses or overlaps itself, and a place where
/// they do.
struct CrossingCells {
  Index first = no_index;
  Index second = no_index;  ///< not below first
  Point place;
};

/// Finds the pairs of cells whose sides cross, each pair once, in lexicographic order: polygons
/// that overlap at their borders, and whose clipped cells overlap there, too. Sides that only
/// touch, or are the same, do not cross. Exact.
/// \throws InvalidInput if the offsets do not fit.
RONDEL_API std::vector<CrossingCells> crossing_cells(const CellRings& cells,
                                                     const Execution& execution = {});

/// Finds the pairs of cells that overlap each other, or themselves, by more than rounding of their
/// corners, each pair once, in lexicographic order: cells that cross, contain or repeat each other,
/// entirely or in part, and rings that bound no region. `place` is the middle of the part that they
/// share, or a place where a cell contradicts itself. Corners of one cell on the side of another
/// are no overlap.
/// \throws InvalidInput as CellSet::polygons(cells).
RONDEL_API std::vector<CrossingCells> overlapping_cells(const CellRings& cells,
                                                        const Execution& execution = {});

/// Computes the area of each cell in steradians, whatever its size and form. A cell that crosses or
/// overlaps itself has none (overlapping_cells() finds it, repaired() of rondel/set_operations.h
/// makes it valid); the result is then the sum of what its sides go around, with their directions.
RONDEL_API std::vector<double> areas(const CellRings& cells);

/// Computes the length of each cell's border in radians: the sum of the lengths of all sides of its
/// rings. It is 0 for a cell without rings.
RONDEL_API std::vector<double> lengths(const CellRings& cells);

/// What cells have to do with each other when they are drawn.
enum class CellDrawing : std::uint8_t {
  /// Cells do not overlap; where they do nevertheless, a place belongs to one of them. Where two
  /// cells meet, both get the same positions, bit by bit, also where only one of them has a corner.
  together,
  /// Cells may overlap: each is drawn as if there were no others. Cells have the same positions
  /// along a common side as long as it is nowhere nearer to other sides than lines are to arcs.
  apart,
};

/// Returns the name of a value: "together", "apart"; empty for other numbers.
RONDEL_API std::string_view name_of(CellDrawing drawing) noexcept;

/// Returns how cells are to be drawn: apart if they overlap by more than rounding, so that none
/// loses a part. \throws InvalidInput as overlapping_cells()
RONDEL_API CellDrawing drawing_of(const CellRings& cells, const Execution& execution = {});

/// Cells as polygons with holes in longitude and latitude: the polygons of write_regions().
struct LonLatRegions {
  /// A group has the rings of a polygon, the outer one first. A row has the positions of a ring,
  /// whose last one equals its first; outer rings are counterclockwise, holes clockwise.
  RowGroups<CompressedRows<LonLat>> polygons;
  std::vector<Index> owners;  ///< the cell of each polygon, never decreasing
};

/// Computes polygons within [-180, 180] x [-90, 90], cut at the antimeridian and the poles (target
/// rondel::geo).
///
/// 1. They are valid in the sense of OGC simple features, exactly, for these doubles.
/// 2. What cells have to do with each other is as `drawing` says.
/// 3. A cell has no polygon where it is no wider than rounding.
///
/// \throws InvalidInput if offsets do not fit, or the tolerance is not positive; no cell is refused
///         for its form.
RONDEL_API LonLatRegions region_polygons(const CellRings& cells, double tolerance_deg = 0.01,
                                         const Execution& execution = {},
                                         CellDrawing drawing = CellDrawing::together);

/// Returns the polygons of each cell: feature i has those of cell i.
/// \throws InvalidInput if an owner is not below the number of cells
RONDEL_API LonLatMultiPolygons multipolygons(LonLatRegions regions, std::size_t num_cells);

/// True if the format can hold regions: .geojson .gpkg .fgb .parquet.
RONDEL_API bool can_write_regions(const FileName& file);

/// Checks, before any work, that write_regions() has what it needs for the format of a file: GDAL
/// for .gpkg, .fgb and .parquet, nothing for others.
/// \throws FileError if GDAL is not found, or has no driver for the format
RONDEL_API void require_region_writer(const FileName& file);

/// Writes cells, one feature for each cell that has rings: a Polygon or MultiPolygon, cut at the
/// antimeridian and the poles. Its properties are `area` (steradians) and the columns. The polygons
/// are those of region_polygons(): valid, and equal along borders. The geometry of a cell without
/// polygons is null; GDAL's formats leave out such a cell. The file appears whole or not at all.
/// \param file  .geojson (RFC 7946), or what GDAL writes: .gpkg (GeoPackage), .fgb (FlatGeobuf),
///         .parquet (GeoParquet), with a MultiPolygon for each feature, and integers in a column
///         that has no other numbers. libgdal (3.0 or newer) is loaded when it is needed: the one
///         that the environment variable RONDEL_GDAL names, or the newest that the system finds.
/// \param columns  one value for each cell; names that are taken change as in free_names()
/// \param ids  .geojson: the member `id` of each feature, as JSON, empty for none; no cells: there
///         are no ids
/// \param drawing  as for region_polygons()
/// \throws InvalidInput if columns, ids or offsets do not fit, or the tolerance is not positive
/// \throws FileError if the file cannot be written, has another ending, or needs a GDAL that is not
///         there
RONDEL_API void write_regions(const FileName& file, const CellRings& cells,
                              std::span<const Column> columns = {}, double tolerance_deg = 0.01,
                              const Execution& execution = {}, const Column& ids = {},
                              CellDrawing drawing = CellDrawing::together);

}  // namespace rondel
