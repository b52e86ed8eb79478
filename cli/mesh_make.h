// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The options of the commands that make meshes: rondel mesh scvt, icosahedral, points, partition.
///
/// in    the command line, and the files of spacings, lines and points that it names
/// out   sites on the unit sphere, or the mesh of their Voronoi cells
/// index sites, which are the cells of the mesh
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "mesh.h"
#include "rondel/scvt.h"

namespace rondel::cli {

/// The kilometers in a radian on a sphere of radius 6371.229 km, which is that of the Earth in
/// MPAS.
inline constexpr double kilometers_per_radian = 6371.229;

/// The options of `rondel mesh scvt`; lengths are kilometers on the Earth of MPAS.
struct ScvtCommandOptions {
  MeshOutput output;
  std::string spacing;              ///< --spacing: kilometers, FILE or FILE:NAME
  std::vector<std::string> refine;  ///< --refine: FILE:KM
  std::optional<double> slope;      ///< --gradient
  std::string start;                ///< --start: sites
  std::string density;              ///< --density: FILE:NAME
  std::vector<std::string> fixed;   ///< --fixed: sites, lines
  std::vector<std::string> along;   ///< --along: lines
  PolygonEdges edges = PolygonEdges::lonlat;
  bool no_repair = false;
  mesh::ScvtOptions scvt;
};

/// The options of `rondel mesh icosahedral`.
struct IcosahedralCommandOptions {
  MeshOutput output;
  unsigned levels = 0;
  bool keep = false;  ///< --no-relax
};

/// The options of `rondel mesh points`.
struct MeshPointsOptions {
  MeshOutput output;
  std::string kind;
  std::size_t size = 0;  ///< --size
  double radius_km = 0;  ///< --radius, for the kind poisson
  std::uint64_t seed = 1;
};

/// The options of `rondel mesh partition`.
struct AreaPartitionCommandOptions {
  CommonOptions common;
  std::string column;  ///< --area
  double tolerance = 1e-12;
};

/// Adds the commands to `rondel mesh`; they are in mesh_commands.cpp.
std::vector<Command> add_mesh_making_commands(CLI::App& mesh);

/// The sites of --fixed and --along.
struct FixedSites {
  std::vector<Point> sites;
  std::size_t num_left_out = 0;  ///< number of sites on lines and beside them that were too close
                                 ///< to others
};

/// The files of --spacing, --refine, --density, --fixed, --along and --start.
std::vector<NamedFile> files_read(const ScvtCommandOptions& options);
/// True if --spacing names a file, and no number of kilometers.
bool is_file_of_spacings(const std::string& spacing);
/// The spacings of --spacing, --refine and --density; none: the same everywhere.
std::optional<mesh::SizeFunction> size_of(const ScvtCommandOptions& options,
                                          const Execution& execution);
/// Returns the fixed sites. On lines, and in rows beside them, they have the spacing of a mesh of
/// `scvt`, which starts with `num_start` given sites (0: none).
FixedSites fixed_sites(const ScvtCommandOptions& options, const mesh::ScvtOptions& scvt,
                       std::size_t num_start, const Execution& execution);

/// These functions run the commands after parsing (mesh_make.cpp).
ExitStatus run_scvt(const ScvtCommandOptions& options);
ExitStatus run_icosahedral(const IcosahedralCommandOptions& options);
ExitStatus run_mesh_points(const MeshPointsOptions& options);
ExitStatus run_area_partition(const AreaPartitionCommandOptions& options);

}  // namespace rondel::cli
