// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The commands of `rondel mesh`, one file each, and what they share.
///
/// in    a mesh of netCDF, or sites, whose mesh is that of their Voronoi cells
/// out   a mesh in a format of models, its graph of neighbors, a report on its quality
/// index cells, edges and vertices, from 0 in C++ and in .npy
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "rondel/mesh.h"
#include "rondel/mesh_io.h"
#include "rondel/mesh_quality.h"
#include "rondel/polygon_files.h"

namespace rondel::cli {

/// The help text that describes INPUT.
inline constexpr const char* mesh_input_help =
    "The mesh, .nc (MPAS, UGRID, SCRIP, ESMF), or its sites: .csv .tsv .xyz .txt .npy\n"
    ".geojson, or - for standard input. Longitude and latitude in degrees, or x, y, z.";

/// The files that a command writes for a mesh: OUTPUT and others beside it.
struct MeshOutput {
  CommonOptions common;          ///< INPUT if the command has one; output, --format, threads
  NetcdfOptions netcdf;          ///< --kind --deflate
  std::string graph;             ///< --graph; empty: not written
  std::string report;            ///< --report; empty: not written
  std::optional<double> radius;  ///< --sphere-radius; if not given: 1, or that of the input mesh
};

/// The options of `rondel mesh convert`.
struct MeshConvertOptions {
  MeshOutput written;  ///< INPUT: sites or a mesh
  bool allow_zero_edges = false;
};

/// The options of `rondel mesh quality`.
struct MeshQualityOptions {
  CommonOptions common;  ///< INPUT: sites or a mesh
  std::string report;    ///< --report; empty: not written
  /// --require: a name of quality_value() and its bound.
  std::vector<std::pair<std::string, double>> required;
};

/// The options of `rondel mesh cull`. The maps are arrays with the new number of each cell, edge or
/// vertex of INPUT.
struct MeshCullOptions {
  MeshOutput written;   ///< INPUT, the mesh that is left
  std::string mask;     ///< --mask: FILE, FILE.nc:NAME or FILE.csv:COLUMN
  std::string inside;   ///< --inside: polygons
  std::string outside;  ///< --outside: polygons
  PolygonEdges polygon_edges = PolygonEdges::lonlat;
  std::string cell_map;    ///< --cell-map; empty: not written
  std::string edge_map;    ///< --edge-map
  std::string vertex_map;  ///< --vertex-map
};

ExitStatus run_mesh_convert(const MeshConvertOptions& options);
ExitStatus run_mesh_cull(const MeshCullOptions& options);
ExitStatus run_mesh_quality(const MeshQualityOptions& options);

/// Writes the mesh, and graph and report if they are wanted, and prints what was written.
void write_and_report_mesh(const MeshOutput& output, const mesh::MeshArrays& arrays, Job& job);

/// Returns the mesh of a file: read_mesh() reads netCDF, and the mesh of sites is computed. \throws
/// FileError with the place of a site that is not accepted
/// \param radius  the radius of the sphere, in metres for most models; not given: 1, or that of the
/// mesh that is read
/// \param allow_zero_edges  accepts edges of length 0, between cells that meet in one point only
mesh::MeshArrays read_mesh_or_sites(Job& job, const CommonOptions& common,
                                    std::optional<double> radius, bool allow_zero_edges);

/// The kinds of files that OUTPUT may be.
enum class MeshOutputKind { mesh, mesh_or_sites };

/// Adds the options that all commands that write a mesh share: --output, --format, --kind,
/// --deflate, --graph, --sphere-radius, --report.
void add_mesh_output_options(CLI::App& parser, MeshOutput& output, MeshOutputKind kind);
/// Checks the files of a command before any work.
/// \param inputs  the files that the command reads beside INPUT
/// \param outputs  the files that it writes beside those of `output`
/// \throws UsageError if OUTPUT has a format in which no mesh is written, nor sites where the
/// command may write these; if --kind is given for a file that is not netCDF; and like
/// require_separate_files()
void require_mesh_output(const MeshOutput& output, MeshOutputKind kind,
                         const std::vector<NamedFile>& inputs = {},
                         const std::vector<NamedFile>& outputs = {});
/// True if OUTPUT is a mesh, and not sites.
bool is_mesh_file(const CommonOptions& common);
/// Returns the format that --format names, or the ending: nc means mpas, exo means exodus. \pre
/// is_mesh_file()
mesh::MeshFormat mesh_format(const CommonOptions& common);
/// Writes graph and report if they are wanted, and OUTPUT if it is a mesh.
void write_mesh_files(const MeshOutput& output, const mesh::MeshArrays& arrays, Job& job);

/// Writes the report of 'rondel mesh quality' in the format of the path's ending: .svg is a
/// picture, .txt the printed text, anything else JSON.
void write_mesh_report(const std::string& path, const mesh::MeshArrays& arrays,
                       const mesh::Quality& quality, const Execution& execution);
/// Adds the option for the file of the report, which has the given names.
void add_mesh_report_option(CLI::App& parser, std::string& report,
                            const std::string& names = "--report");

/// Returns FILE and the text behind its last colon, except for the colon of C:\.
std::pair<std::string, std::string> split_at_colon(const std::string& text);

/// Each of these functions adds one command to `rondel mesh`, in the file of its name.
Command add_mesh_cull_command(CLI::App& mesh);
Command add_mesh_convert_command(CLI::App& mesh);
Command add_mesh_quality_command(CLI::App& mesh);

}  // namespace rondel::cli
