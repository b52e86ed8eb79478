// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Meshes as the files of models and their tools (target rondel::mesh). Every function throws FileError with one
/// line that names the file; output appears complete or not at all, and equal meshes give equal bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/mesh.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// The conventions that files of meshes follow. All are netCDF, in double precision.
enum class MeshFormat : std::uint8_t {
  mpas,  ///< all arrays, TRiSK's weights among them, as the specification of MPAS meshes names them
  ugrid,  ///< CF-1.11 UGRID-1.0: faces, edges, nodes and how they meet
  scrip,  ///< the corners of each cell, for SCRIP, NCO, ESMF, CDO
  esmf,   ///< ESMF's unstructured mesh
  exodus,  ///< Exodus II on the unit sphere as TempestRemap has it: a block for each number of corners
};

using rondel::NetcdfKind;

struct MeshFileOptions {
  MeshFormat format = MeshFormat::mpas;
  /// by_name: netCDF-4 where the name of the file ends in .nc4, otherwise CDF-5.
  NetcdfKind kind = NetcdfKind::by_name;
  int deflate = 1;  ///< as that of NetcdfOptions
};

/// Writes the mesh, piece by piece: nothing of the file's size is in memory.
///
/// 1. Numbers start at 1 in MPAS, ESMF and Exodus, at 0 in UGRID; at a border none is 0 or -1. Longitudes are from 0 to
///    below 2 pi, or 360 degrees; at the poles 0.
/// 2. MPAS: lengths and areas as in the arrays; besides what the specification asks for, meshDensity, nominalMinDc
///    (the smallest dcEdge), and the qualities of cells and triangles that MPAS-Tools writes, at a border 0. The file_id
///    is a hash of the mesh.
/// 3. The other formats have areas on the unit sphere. Corners that an edge without length joins are one corner.
/// 4. Cells of Exodus are ordered by their number of corners; elem_num_map and global_id of each block have their
///    numbers from 1 on.
/// \throws InvalidInput if the arrays do not fit together; FileError also for CDF-2 that cannot hold the mesh.
RONDEL_API void write(const std::string& path, const MeshArrays& arrays,
                      const MeshFileOptions& options = {}, const Execution& execution = {});

/// Writes which cells are neighbors, for METIS: MPAS's graph.info.
RONDEL_API void write_graph(const std::string& path, const MeshArrays& arrays,
                            const Execution& execution = {});

/// Reads the arrays of an MPAS mesh of the sphere or a part of it, whoever wrote it. What write() wrote comes back bit for
/// bit, but a density of 1 everywhere as none.
///
/// 1. Areas, lengths, angles and points are those of the file, whatever their precision; points that are not on the
///    sphere within a thousandth of sphere_radius (1 where it is missing) are refused. The
///    order and the start of lists are those of edgesOnCell and cellsOnVertex; the others follow from them, and from the
///    edges.
/// 2. The file's lists must describe a surface, closed or with a border, with edges counterclockwise around cells; 0
///    is none.
RONDEL_API MeshArrays read_mpas(const FileName& file, const Execution& execution = {});

/// Reads a mesh of any kind: MPAS as read_mpas(); UGRID, SCRIP and ESMF by the centers and corners of their cells.
///
/// 1. Cells that cover the sphere: the mesh is made again of the centers, as arrays() does.
/// 2. Cells with a border: the mesh has the rings of the file, in the order of its cells and corners. What is not in the file is
///    made of centers and corners: middles of edges, lengths, kites. Beyond an edge of the border the cell that is gone is
///    supposed to have had its site where that of the edge's cell is reflected, so that all is that of cull(), as far as
///    degrees tell, but for the numbers of vertices and edges: vertices are in the order of the file's corners, of SCRIP in that in which cells come to
///    them, and edges in the order of the first of their two vertices.
/// 3. Such files do not say the radius and the density; `options` do.
/// \param remarks  gets the remarks of the file's cells (CellTable): how many are masked, which of several meshes is read
/// \throws FileError also if the file has no centers, or a corner of a cell is farther than a thousandth of the spacing
///         from where the cells of Voronoi have it; with a border, if more than three cells meet in a corner, or three and the border.
RONDEL_API MeshArrays read_mesh(const FileName& file, const MeshOptions& options = {},
                                const Execution& execution = {},
                                std::vector<std::string>* remarks = nullptr);

}  // namespace rondel::mesh
