// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Reading and writing of meshes in the formats of models and their tools (target rondel::geo).
/// Every function throws FileError with one line that names the file. Output appears complete or
/// not at all, and equal meshes give equal bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/mesh.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// The conventions that files of meshes follow. All files are netCDF, in double precision.
enum class MeshFormat : std::uint8_t {
  mpas,   ///< all arrays, and the weights of TRiSK, named by the specification of MPAS meshes
  ugrid,  ///< CF-1.11 UGRID-1.0: faces, edges, nodes and their connectivity
  scrip,  ///< the corners of each cell, for SCRIP, NCO, ESMF, CDO
  esmf,   ///< ESMF's unstructured mesh
  /// Exodus II on the unit sphere as TempestRemap writes it: one block for each number of corners
  exodus,
};

/// Returns the name of a value: "mpas", "ugrid" ...; empty for other numbers.
RONDEL_API std::string_view name_of(MeshFormat format) noexcept;

using rondel::NetcdfKind;

struct MeshFileOptions {
  MeshFormat format = MeshFormat::mpas;
  /// by_name is netCDF-4 if the name of the file ends in .nc4, and otherwise CDF-5.
  NetcdfKind kind = NetcdfKind::by_name;
  int deflate = 1;  ///< as in NetcdfOptions
};

/// Writes a mesh, piece by piece, so that the memory does not grow with the size of the file.
///
/// 1. Indices begin with 1 in MPAS, ESMF and Exodus, and with 0 in UGRID; a missing element at a
///    border is 0 or -1. Longitudes are from 0 to below 2 pi, or 360 degrees; at the poles they are
///    0.
/// 2. MPAS has the lengths and areas of the arrays. Besides what the specification requires, it has
///    meshDensity, nominalMinDc (the smallest dcEdge), and the qualities of cells and triangles
///    that MPAS-Tools writes, 0 at a border. The file_id is a hash of the mesh.
/// 3. The other formats have areas on the unit sphere. Corners joined by an edge of length 0 are
///    one corner.
/// 4. The cells of Exodus are ordered by their number of corners; elem_num_map and the global_id of
///    each block have their numbers, from 1 on.
/// \throws InvalidInput if the arrays do not fit together, or have numbers that no mesh has
/// \throws FileError also if CDF-2 cannot hold the mesh
RONDEL_API void write(const FileName& file, const VoronoiMesh& mesh,
                      const MeshFileOptions& options = {}, const Execution& execution = {});

/// A variable of a file, with its values.
struct FileVariable {
  std::string name;
  std::vector<std::string> dimensions;  ///< the last one varies fastest
  std::vector<std::uint64_t> shape;     ///< the lengths of the dimensions
  std::variant<std::vector<std::int32_t>, std::vector<double>> values;
};

/// The variables and attributes of a file of MPAS.
struct MpasContent {
  std::vector<FileVariable> variables;
  std::vector<std::pair<std::string, std::variant<std::string, double>>> attributes;
};

/// Returns what write() writes of a mesh for MPAS, except for what follows from other variables
/// (weights, qualities, marks of the border, edges of edges) and for the origin of the file.
/// \throws InvalidInput as write() does
RONDEL_API MpasContent mpas_content(const VoronoiMesh& mesh, const Execution& execution = {});

/// Writes which cells are neighbors, as METIS reads it: MPAS's graph.info.
RONDEL_API void write_graph(const FileName& file, const VoronoiMesh& mesh,
                            const Execution& execution = {});

/// Reads an MPAS mesh of the sphere or a part of it, written by any program. A mesh that write()
/// wrote is read back bit for bit, except that a density of 1 everywhere is read as no density.
///
/// 1. Areas, lengths, angles and points are those of the file, whatever their precision. Points
///    that are farther from the sphere than a thousandth of sphere_radius (1 if it is missing) are
///    refused. The order and the start of lists are those of edgesOnCell and cellsOnVertex; the
///    other lists follow from these and from the edges.
/// 2. The file's lists must describe a surface, closed or with a border, with edges
///    counterclockwise around cells; 0 stands for a missing element.
/// 3. Numbers that contradict the points are refused: dcEdge and dvEdge by more than a tenth
///    (dvEdge by a quarter of dcEdge besides), angleEdge by more than 0.5 between two cells away
///    from the poles, areaCell by a factor of more than 2, and longitudes and latitudes that are
///    not the directions of x, y and z. The normal of an edge of the border is made to point
///    outward.
RONDEL_API VoronoiMesh read_mpas(const FileName& file, const Execution& execution = {});

/// Reads a mesh of any convention: MPAS as read_mpas() does; UGRID, SCRIP and ESMF by the centers
/// and corners of their cells.
///
/// 1. If the cells cover the sphere, the mesh is computed again from the centers, as by
///    make_mesh().
/// 2. If the cells have a border, the mesh has the rings of the file, in the order of its cells and
///    corners. Middles of edges, lengths and kites, which the file does not have, are computed from
///    centers and corners. The missing cell beyond an edge of the border is taken to have its site
///    where that of the edge's cell is reflected. So the result is that of cull(), up to the
///    rounding of degrees, except for the order of vertices and edges: vertices are in the order of
///    the file's corners (for SCRIP, in the order in which cells first have them), and edges in the
///    order of the first of their two vertices.
/// 3. Such files do not contain the radius and the density; `options` do.
/// 4. Cells that the file masks, or that lack corners, are left out; the others keep their order.
/// \param remarks  gets the remarks of the file's cells (CellTable): how many are masked, which of
///                 several meshes is read; and which variables of the file are no part of the mesh
/// \throws FileError also if the file has no centers, if a corner of a cell is farther than a
///         thousandth of the spacing from that of the Voronoi cell, or one of these is missing, or
///         if all cells are masked; with a border, if more than
///         three cells, or three and the border, meet in a corner.
RONDEL_API VoronoiMesh read_mesh(const FileName& file, const MeshOptions& options = {},
                                 const Execution& execution = {},
                                 std::vector<std::string>* remarks = nullptr);

}  // namespace rondel::mesh
