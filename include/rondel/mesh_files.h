// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The cells of models' files: unstructured meshes and grids in longitude and latitude (target rondel::remap).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/partition.h"
#include "rondel/types.h"
#include "rondel/weight_files.h"

namespace rondel {

/// The cells of a file: in `cells`, or, if it has coordinates along lines, in `grid`.
struct CellTable {
  std::string name;        ///< the file, for messages
  std::string convention;  ///< "UGRID", "SCRIP", "ESMF", "MPAS", "ICON", "OASIS", "Exodus" or "CF"
  CellRings cells;
  std::optional<LonLatGrid> grid;
  std::vector<LonLat> centers;       ///< as the file has them; empty: it has none
  std::vector<std::int32_t> mask;    ///< 0: the cell takes no part; empty: all do
  std::vector<std::uint64_t> shape;  ///< of a grid, the last dimension changes fastest: nlat, nlon
  std::vector<std::string>
      remarks;  ///< sentences: what is masked or left out, which grid of several was read

  [[nodiscard]] RONDEL_API std::size_t num_cells() const;
};

/// The grid whose cells have these centers, by rule 3 of read_cells(). Longitudes increase but for whole turns.
/// \throws InvalidInput for less than two, or what is not finite (its index).
RONDEL_API LonLatGrid grid_around(std::span<const double> lon_deg, std::span<const double> lat_deg);

/// Cells by the positions of their corners, `of_each` a cell, as CF's bounds have them. As in read_cells(), corners
/// nearer than 1e-10 radians to each other are one.
/// \throws InvalidInput if `of_each` is 0 or does not divide their number, or with the cell that has a corner at
/// no place.
RONDEL_API CellRings cells_of_corners(std::span<const LonLat> corners, std::size_t of_each);

/// Reads netCDF of any format. Its variables and attributes tell which convention it follows:
///
/// | convention | cells |
/// | --- | --- |
/// | UGRID | the faces of the first mesh_topology of dimension 2 |
/// | SCRIP | grid_corner_lon, grid_corner_lat; the mask grid_imask |
/// | ESMF | elementConn of nodeCoords, with polybreak_value; the mask elementMask |
/// | MPAS | verticesOnCell of lonVertex, latVertex |
/// | ICON | vertex_of_cell of vlon, vlat |
/// | OASIS | NAME.clo, NAME.cla; the mask NAME.msk |
/// | Exodus | connect1, connect2 ... of coord, or of coordx, coordy, coordz |
/// | CF | coordinates of units degrees_east and degrees_north: along one dimension each, with bounds or between them; or of the same dimensions, with bounds |
///
/// 1. Coordinates have the units that they say, in any of UDUNITS's spellings for degrees and radians; those without units are
///    radians in MPAS and ICON, else degrees. Bounds without units have those of their coordinate.
/// 2. Corners nearer than 1e-10 radians to each other are one, in single precision 1e-6: the same
///    corner may be 0 and 2 pi. A corner that repeats the one before it is left out; cells with
///    less than three corners have no ring. Rings that are clockwise are turned around.
/// 3. Coordinates along lines and without bounds: cells end half way between them, the first and the last one as far
///    beyond as before, or at the pole if that is less than a cell away.
/// 4. Cells that the file masks have a mask of 0, as cells with a corner that is missing (NaN, a fill value), which have no ring.
/// 5. `FILE.nc:NAME` names the grid of several by one of its variables: a coordinate, a UGRID topology, or values on it.
/// \throws FileError for what cannot be read, with the file, and the cell or node.
RONDEL_API CellTable read_cells(const FileName& file);

/// Whether the format of the file, without the name of a grid, is one that read_cells() reads.
RONDEL_API bool can_read_cells(const FileName& file);

/// The places of a netCDF file.
struct NetcdfSites {
  SiteTable table;                   ///< with positions
  std::vector<std::uint64_t> shape;  ///< the lengths of their dimensions: nlat, nlon for a grid
  /// 0: a mask of SCRIP, ESMF or OASIS says that the cell takes no part; empty: all do.
  std::vector<std::int32_t> mask;
  std::vector<std::string> remarks;  ///< those of the cells; what is no column, and why

  /// Whether each site takes part.
  [[nodiscard]] std::vector<bool> unmasked() const {
    std::vector<bool> takes_part(table.sites.size(), true);
    for (std::size_t i = 0; i < mask.size(); ++i) takes_part[i] = mask[i] != 0;
    return takes_part;
  }
};

/// Reads sites from netCDF: the centers of the cells that read_cells() finds, or else the places of the first of the fields
/// that has some (rondel/fields.h).
/// \param names  the fields in question; their values, where a field has one at each site, are columns of the table if
///               columns are kept. Empty: all.
RONDEL_API NetcdfSites read_netcdf_sites(const FileName& file, std::span<const std::string> names,
                                         bool keep_columns);

/// The partition that the cells are. \throws FileError with the file's name for cells that Partition refuses.
RONDEL_API Partition partition_of(const CellTable& table, GridSides sides = GridSides::parallels,
                                  const Execution& execution = {});

/// Returns what a file of weights says of these cells: their centers, the file's or the centers of mass, the mask, the shape of the grid, and the
/// corners.
RONDEL_API WeightSide weight_side(const CellTable& table, const Partition& partition);

/// The corners of cells with one ring each and 16 corners at most, as many for each: the last one is repeated, and (0, 0) those of cells
/// without ring. Empty for other cells.
RONDEL_API std::vector<LonLat> weight_corners(const Partition& partition);

}  // namespace rondel
