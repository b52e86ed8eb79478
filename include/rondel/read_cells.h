// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Reading the cells of models: unstructured meshes and grids in longitude and latitude (target
/// rondel::geo).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/types.h"

namespace rondel {

/// Returns the grid whose cells have these centers, by rule 3 of read_cells(). Longitudes ascend or
/// descend, except for jumps by 360 degrees.
/// \throws InvalidInput for less than two coordinates, or one that is not finite (its index).
RONDEL_API LonLatGrid grid_around(std::span<const double> lon_deg, std::span<const double> lat_deg);

/// Returns the cells with these corners, `corners_per_cell` consecutive ones for each cell, as in
/// bounds of CF. As in read_cells(), corners nearer than 1e-10 radians to each other are one.
/// \throws InvalidInput if `corners_per_cell` is 0 or does not divide the number of corners, or
///         (with the cell) if a corner is no place.
RONDEL_API CellRings cells_of_corners(std::span<const LonLat> corners,
                                      std::size_t corners_per_cell);

/// The lengths of both dimensions of an array.
struct GridShape {
  std::size_t rows;
  std::size_t columns;
};

/// Returns four corners for each cell of a grid, in their order around it, from the nodes between
/// the cells. The two dimensions of the nodes may be in the other order than those of the cells.
/// Where their lengths do not say which order it is, it is the one in which the centers are nearer
/// to the middles of their cells.
/// \param nodes       one row and one column more than cells, in one grid or several
/// \param node_shape  the shape of the nodes of one grid
/// \param centers     of the cells, NaN where they are missing
/// \param shape       the shape of the cells of one grid
/// \throws InvalidInput if these numbers do not fit.
RONDEL_API std::vector<LonLat> corners_of_grid(std::span<const LonLat> nodes, GridShape node_shape,
                                               std::span<const LonLat> centers, GridShape shape);

/// Returns nodes between the places of a grid, one row and one column more than places, for grids
/// that have centers alone: those of models in curvilinear coordinates, swaths of satellites.
///
/// 1. A node is in the direction of the mean of the four centers around it, as unit vectors.
/// 2. Beyond the border, and where a center is missing, one is extrapolated: it is the mean of the
///    mirror images b' = 2 (a.b) a - b of the next but one center b in the next one a, along the
///    rows and columns in which both are there; where there are none, of those that were found so.
/// 3. If the last column is beside the first one (grid_neighbors() of rondel/extrapolate.h), the
///    grid goes around, and the first and the last column of nodes are the same.
/// 4. A node without four centers is missing (NaN).
///
/// \param centers  in degrees, row by row, NaN where they are missing
/// \throws InvalidInput if there are not as many centers, or less than two rows or columns
RONDEL_API std::vector<LonLat> nodes_between(std::span<const LonLat> centers, GridShape shape);

/// Centers that lie outside of their cells.
struct CentersOutside {
  std::size_t number = 0;  ///< how many there are
  std::size_t of = 0;      ///< the number of cells with a center that have been looked at
  std::size_t first = 0;   ///< the first such cell
  /// How many of `number` are at longitude and latitude 0, as files have it under land.
  std::size_t zeros = 0;

  /// True if more than half of the centers are outside (zeros do not count): corners and centers
  /// are then of different places, or have different orders.
  [[nodiscard]] bool are_most() const { return 2 * (number - zeros) > of - zeros; }
};

/// Finds the centers that are farther from the middle of their cell than all of its corners, which
/// no point of the cell is. (A center may be outside of a cell and nearer than this.)
/// \param centers  one for each cell; those that are no places are not looked at
/// \param mask     0: the cell is not looked at; empty: all are
/// \throws InvalidInput if there are not as many centers, or numbers of the mask, as cells.
RONDEL_API CentersOutside centers_outside(const CellRings& cells, std::span<const LonLat> centers,
                                          std::span<const std::int32_t> mask = {});

/// Reads the cells of a netCDF file of any format. Its variables and attributes tell which
/// convention it follows:
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
/// 1. Coordinates have the units that they declare, in any of UDUNITS's spellings for degrees and
///    radians; those without units are radians in MPAS and ICON, else degrees. Bounds without units
///    have those of their coordinate.
/// 2. Corners nearer than 1e-10 radians to each other (1e-6 in single precision) are one: the same
///    corner may have the longitudes 0 and 2 pi. A corner that repeats the one before it is
///    dropped; cells with less than three corners have no ring. Clockwise rings are reversed.
/// 3. If coordinates are along axes and have no bounds, cells end half way between them. The first
///    and the last cell extend as far beyond their coordinate as before it, and on to the pole if
///    that is less than a cell beyond.
/// 4. A cell that the file masks has a mask of 0. So has a cell with a corner that is missing (NaN,
///    a fill value); it has no ring.
///    Centers of CF that are outside of their cells (centers_outside()) are an error if they are
///    more than half (zeros under land do not count), and otherwise a remark.
/// 5. `FILE.nc:NAME` chooses one of several grids by one of its variables: a coordinate, a UGRID
///    topology, or values on the grid.
/// 6. Numbers of corners that are no nodes may only stand at the end of a row without a count, or
///    make up all of a row. With conventions other than CF it is an error if the center of a cell
///    belongs to another cell by the rule in docs/guide/formats.md (cells), and otherwise a remark
///    if it is outside of the circle around the corners. Masked cells may have any corners and
///    centers.
/// \param corners  where the corners are not in the file, for coordinates of two dimensions. Those
///                 that are made are told by a remark and by CellFacts::are_corners_made.
/// \throws FileError for what cannot be read, with the file, and the cell or node.
RONDEL_API CellTable read_cells(const FileName& file,
                                MissingCorners corners = MissingCorners::error);

/// True if read_cells() reads files of this format; the name of a grid (`FILE.nc:NAME`) is ignored.
RONDEL_API bool can_read_cells(const FileName& file);

/// True if read_polygons() reads polygons from the file: of .geojson and .json, and by GDAL of .gpkg,
/// .fgb, .shp and .parquet whose first feature with a place has some; other files of GDAL, and
/// those from a pipe, have sites.
/// \throws FileError for a file of GDAL's formats that cannot be read
RONDEL_API bool can_read_polygons(const FileName& file);

/// Checks a text that is the name of a grid (NamedGrid) or of a file.
/// \throws FileError for one that is neither and looks like no file: "healpx:7", which has no ending
///         and no folder. A missing file that looks like one is left to its reader.
RONDEL_API void require_grid_or_file(const FileName& side);

/// The sites of a netCDF file.
struct NetcdfSites {
  SiteTable table;  ///< with positions
  /// The lengths of the dimensions of the sites: nlat, nlon for a grid.
  std::vector<std::uint64_t> shape;
  /// 0 if a mask of SCRIP, ESMF or OASIS says that the cell takes no part; empty if all do.
  std::vector<std::int32_t> mask;
  /// Remarks about the cells, and about fields that are no column.
  std::vector<std::string> remarks;

  /// Returns for each site whether it takes part.
  [[nodiscard]] std::vector<bool> unmasked() const {
    std::vector<bool> takes_part(table.sites.size(), true);
    for (std::size_t i = 0; i < mask.size(); ++i) takes_part[i] = mask[i] != 0;
    return takes_part;
  }
};

/// Reads sites from netCDF: the centers of the cells that read_cells() finds, or else the places of
/// the first field that has places (rondel/fields.h).
/// \param names  the fields in question; empty: all. If columns are kept and a field has one value
///               at each site, it is a column of the table
RONDEL_API NetcdfSites read_netcdf_sites(const FileName& file, std::span<const std::string> names,
                                         bool keep_columns);

/// Reads fields whose places another file has, as models write them that keep their mesh apart: at
/// the nodes or at the cells of the mesh, as many as the last dimension of the first field has, or
/// else another one.
/// \param data  netCDF, whose own places do not matter
/// \param mesh  netCDF with a mesh; `FILE.nc:NAME` names a variable or a topology
/// \param names  the fields, at least one
/// \param keep_columns  whether fields with one value at each place become columns of the table
/// \throws FileError if the field has neither length, or the mesh as many nodes as cells, or some of
///         the places are missing
RONDEL_API NetcdfSites read_sites_on_mesh(const FileName& data, const FileName& mesh,
                                          std::span<const std::string> names, bool keep_columns);

}  // namespace rondel
