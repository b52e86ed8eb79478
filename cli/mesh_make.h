// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The options of the commands that make meshes: rondel mesh scvt, icosahedral, points, partition.
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

/// Kilometers on the Earth, a sphere of 6371.229 km as MPAS has it, for a radian.
inline constexpr double kilometers_per_radian = 6371.229;

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

struct IcosahedralCommandOptions {
  MeshOutput output;
  unsigned levels = 0;
  bool keep = false;  ///< --no-relax
};

struct MeshPointsOptions {
  MeshOutput output;
  std::string kind;
  std::size_t size = 0;  ///< --size
  double radius_km = 0;  ///< --radius, of poisson
  std::uint64_t seed = 1;
};

struct AreaPartitionCommandOptions {
  CommonOptions common;
  std::string column;  ///< --area
  double tolerance = 1e-12;
};

/// Adds them to `rondel mesh`: mesh_commands.cpp.
std::vector<Command> add_mesh_making_commands(CLI::App& mesh);

/// The places of --fixed and --along.
struct FixedSites {
  std::vector<Point> sites;
  std::size_t num_left_out = 0;  ///< on lines and beside them
};

/// The files of --spacing, --refine, --density, --fixed, --along and --start.
std::vector<NamedFile> files_read(const ScvtCommandOptions& options);
/// The spacings of --spacing, --refine and --density; none: the same everywhere.
std::optional<mesh::SizeFunction> size_of(const ScvtCommandOptions& options,
                                          const Execution& execution);
/// Sites on lines, and rows beside them, have the spacing of a mesh of `scvt`, which starts with so many sites; 0: with none.
FixedSites fixed_sites(const ScvtCommandOptions& options, const mesh::ScvtOptions& scvt,
                       std::size_t num_start, const Execution& execution);

ExitStatus run_scvt(const ScvtCommandOptions& options);
ExitStatus run_icosahedral(const IcosahedralCommandOptions& options);
ExitStatus run_mesh_points(const MeshPointsOptions& options);
ExitStatus run_area_partition(const AreaPartitionCommandOptions& options);

}  // namespace rondel::cli
