// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Files of meshes of triangles, for ocean models and their tools (target rondel::geo).
#pragma once

#include <string>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/triangle_mesh.h"

namespace rondel::mesh {

/// True if the name or the format of a file is that of a mesh of triangles:
///
/// | format | ending | |
/// | --- | --- | --- |
/// | gmsh, gmsh2 | .msh | Gmsh's text formats 4.1 and 2.2: x, y, z, physical groups, depths |
/// | adcirc | .14 | ADCIRC's fort.14: degrees, depths, segments with types |
/// | schism | .gr3 .ll | SCHISM's hgrid.gr3 and hgrid.ll, as fort.14 |
/// | sms | .2dm | SMS's 2DM: degrees, elevations, segments as nodestrings |
/// | fesom | a folder, or its nod2d.out | FESOM2's nod2d.out, elem2d.out and aux3d.out |
///
/// A file without a format is a folder of FESOM if it is a folder with nod2d.out.
RONDEL_API bool is_triangle_mesh_file(const FileName& file);

/// True if a netCDF file has a mesh of UGRID with faces of three nodes and no centers of faces, as
/// write_triangle_mesh() writes it: triangles are meant, and no Voronoi cells. False for others,
/// among them files that cannot be read.
RONDEL_API bool is_ugrid_of_triangles(const FileName& file);

/// True if write_triangle_mesh() knows the format: is_triangle_mesh_file(), or UGRID's by the format
/// `ugrid` or the ending .nc .nc4 .ug.
RONDEL_API bool can_write_triangle_mesh(const FileName& file);

/// True if write_triangle_mesh() writes longitudes and latitudes: in all formats but Gmsh's.
RONDEL_API bool has_nodes_in_degrees(const FileName& file);

/// Writes a mesh of triangles: in the formats of is_triangle_mesh_file(), and as netCDF by the
/// conventions of UGRID. Equal meshes give equal bytes. Files appear complete or not at all, for
/// FESOM all three together, in a folder that is made if there is none.
///
/// 1. Numbers have the shortest digits that give back the same bits. Degrees are `positions` or,
///    where the mesh has none, those with few decimals where these are the node's. Where rounding
///    them turns a sliver over, one of its nodes moves by less than 1e-12 degrees, so that triangles are
///    counterclockwise on the sphere by the numbers in the file. Gmsh's x, y, z are `points`, of the length that
///    they have.
/// 2. What a format cannot hold is left out: ADCIRC's numbers in all but ADCIRC's and SCHISM's files
///    and UGRID; `levels` in all but FESOM's; kinds and order of segments in FESOM's, which marks
///    the nodes of the border. `remarks` say what of the mesh is lost so: levels, types, open
///    segments. Open segments come first in ADCIRC's and SCHISM's files.
/// 3. Where depths are needed and the mesh has none, they are 0. FESOM needs at least three levels:
///    without levels they are 0, half of the largest depth, and the largest depth.
/// \param remarks  gets a sentence for all that the format does not hold
/// \throws InvalidInput if there are no triangles; as require_valid() does; (the position of the
///         triangle) if one has no area in degrees all the same: is turned over on the sphere, or, but
///         for UGRID, whose readers are on the sphere, has its corners on one line of the plane of
///         longitude and latitude, by exact arithmetic (leave_out_flat() leaves out those on the
///         border); for FESOM (the node) if a depth is negative
/// \throws FileError for other endings, and if the system refuses
RONDEL_API void write_triangle_mesh(const FileName& file, const TriangleMesh& mesh,
                                    const NetcdfOptions& netcdf = {},
                                    const Execution& execution = {},
                                    std::vector<std::string>* remarks = nullptr);

/// Reads a mesh of triangles: what write_triangle_mesh() wrote is read back bit by bit.
///
/// 1. Depths that are all 0 are read as no depths, and levels as above as no levels. Files in
///    degrees give unit vectors as `points`; those of Gmsh have to be on a sphere around the origin,
///    to a thousandth of its radius.
/// 2. Triangles that are clockwise are turned. Files without segments get those of
///    boundary_segments(), all of land.
/// 3. In 2DM a nodestring without the word open, land or island is open water, and the rest of the
///    border is land. In Gmsh's files segments are the lines in physical groups of these names.
/// 4. ADCIRC's boundaries with numbers at their nodes (weirs and pipes, types 3, 4, 5, 13, 23, 24,
///    25 and 64) become land: their two sides, if they have two.
/// \param remarks  gets a sentence for all that was left out or changed
/// \throws FileError with file, line and value for a file that cannot be understood, for elements
///         that are no triangles, for a file without triangles, for triangles that overlap around a
///         node of the border, and for what require_valid() refuses
RONDEL_API TriangleMesh read_triangle_mesh(const FileName& file, const Execution& execution = {},
                                           std::vector<std::string>* remarks = nullptr);

}  // namespace rondel::mesh
