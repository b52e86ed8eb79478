// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Cells of regions: what lies in a country, on land, within a border; and cells joined by group.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/partition.h"
#include "rondel/types.h"

namespace rondel {

/// What cells have in common with regions. Piece k is that of `cells[k]` and `regions[k]`; pieces are
/// sorted by both.
struct RegionPieces {
  CellRings rings;
  std::vector<Index> cells;
  std::vector<Index> regions;

  [[nodiscard]] std::size_t num_pieces() const { return cells.size(); }
};

/// The pieces of the overlay of cells and regions, as polygons.
///
/// 1. Which edges cross is decided as remap() decides it; corners where they do are rounded.
/// 2. Rings are simple and meet at most in points; a ring begins at its corner with the least coordinates.
///    Where two pieces meet, both have the same corners, bit by bit.
/// 3. Rings without area but rounding are left out.
/// 4. A piece that is the whole sphere has no border, and so no rings: `rings.whole` names it.
/// 5. The result depends on the cells and their order alone, not on the number of threads.
///
/// If neither partition is_cover(), one is filled up as remap() does it: sides of its cells get corners where those of
/// other cells of it, or the ends of the axes, lie on them, and that takes longer.
/// \throws InvalidInput if a partition is a grid of parallels, a cell crosses or overlaps itself, or neither is_cover() and
///         cells of both overlap, with two of each.
RONDEL_API RegionPieces intersection(const Partition& cells, const Partition& regions,
                                     const Execution& execution = {});

/// The part of each cell that lies in any of the regions: the pieces of intersection(), joined to their
/// cell. A cell of which nothing is left has no rings; `whole` names one of which the whole sphere is left. Regions that overlap are united first. Regions that share a
/// border have to name the same corners along it; otherwise it stays visible.
/// \throws InvalidInput as intersection().
RONDEL_API CellRings clip(const Partition& cells, const Partition& regions,
                          const Execution& execution = {});

/// Cells joined by group: cell i becomes a part of `groups[i]`, or of nothing if that is no_index. Edges
/// that two cells of one group have in common vanish; those between groups are the same for both, bit by bit. A group
/// that covers the sphere has no border, and so no rings: `whole` names it.
/// \throws InvalidInput if there is not one group a cell, or one is neither below num_groups nor no_index (its
///         index).
RONDEL_API CellRings dissolve(const CellRings& cells, std::span<const Index> groups,
                              std::size_t num_groups, const Execution& execution = {});

/// Pieces joined: those of the same group of cells and the same group of regions become one, as dissolve() joins
/// cells. What is in no group (no_index) is left out; no groups at all: each is its own.
/// \return sorted by both groups, which `cells` and `regions` then name
/// \throws InvalidInput if a cell or region has no group
RONDEL_API RegionPieces dissolve(const RegionPieces& pieces, std::span<const Index> cell_groups,
                                 std::span<const Index> region_groups,
                                 const Execution& execution = {});

/// Two cells that cross or overlap, or a cell that does so with itself, and a place where they do.
struct CrossingCells {
  Index first = no_index;
  Index second = no_index;  ///< not below first
  Point place;
};

/// Which cells cross each other, in lexicographic order, each pair once: polygons that overlap at their borders, and whose
/// clipped cells overlap there, too. Sides that only touch, or are the same, do not cross. Exact.
/// \throws InvalidInput if the offsets do not fit.
RONDEL_API std::vector<CrossingCells> crossing_cells(const CellRings& cells,
                                                     const Execution& execution = {});

/// Finds the cells that overlap each other, or themselves, by more than rounding of their corners, in lexicographic order, each pair
/// once: cells that cross, contain or repeat each other, wholly or in part, and rings that are not those of a region.
/// `place` is the middle of the part that they share, or a place where a cell contradicts itself. Corners of one cell on the side
/// of another are no overlap.
/// \throws InvalidInput as Partition(cells).
RONDEL_API std::vector<CrossingCells> overlapping_cells(const CellRings& cells,
                                                        const Execution& execution = {});

/// The area of each cell in steradians, whatever its size and form.
RONDEL_API std::vector<double> areas(const CellRings& cells);

/// Cells as polygons with holes in longitude and latitude, in flat arrays: the polygons of write_regions().
struct LonLatRegions {
  std::vector<LonLat> positions;  ///< of all rings; the last one of a ring is its first
  /// Ring k: `positions[rings[k]] ... positions[rings[k+1]-1]`; outer rings counterclockwise, holes clockwise.
  std::vector<std::uint64_t> rings = {0};
  std::vector<std::uint64_t> polygons = {
      0};                     ///< polygon j: rings from `polygons[j]` on, the outer one first
  std::vector<Index> owners;  ///< the cell of each polygon, never decreasing
};

/// Polygons within [-180, 180] x [-90, 90], cut at the antimeridian and the poles (target rondel::io).
///
/// 1. They are valid as simple features have it, exactly, for these doubles.
/// 2. Where two cells meet, both have the same positions, bit by bit, also where only one of them has a corner.
/// 3. A cell has no polygon where it is no wider than rounding.
///
/// Where cells overlap and their sides cross, a place belongs to the first of them.
/// \throws InvalidInput if offsets do not fit, or the tolerance is not positive; no cell is refused for its form.
RONDEL_API LonLatRegions region_polygons(const CellRings& cells, double tolerance_deg = 0.01,
                                         const Execution& execution = {});

/// Writes a feature for each cell that has rings: a Polygon or MultiPolygon, cut at the antimeridian and
/// the poles. Its properties are `area` (steradians) and the columns, of which each has a value a cell.
/// The file is .geojson (RFC 7946), its polygons are region_polygons(): valid, and equal along borders. The geometry of a
/// cell without polygons is null.
/// \throws InvalidInput if columns or offsets do not fit, or the tolerance is not positive; FileError if the file cannot be
///         written, or has another ending
RONDEL_API void write_regions(const FileName& file, const CellRings& cells,
                              std::span<const Column> columns = {}, double tolerance_deg = 0.01,
                              const Execution& execution = {});

}  // namespace rondel
