// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The commands of `rondel mesh` read a mesh, or make one of sites, and write it by these functions.
///
/// in    a mesh of netCDF, or sites, whose mesh is that of their Voronoi cells
/// out   a mesh in a format of models, its graph of neighbors, a report on its quality
/// index cells, edges and vertices, from 0 in C++ and in .npy
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "job.h"
#include "rondel/mesh.h"
#include "rondel/mesh_formats.h"
#include "rondel/mesh_quality.h"
#include "rondel/mesh_size.h"
#include "rondel/triangle_mesh.h"

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

/// Returns the mesh of a file: read_mesh() reads netCDF, and the mesh of sites is computed. \throws
/// FileError with the place of a site that is not accepted
/// \param radius  the radius of the sphere, in metres for most models; not given: 1, or that of the
/// mesh that is read
/// \param allow_zero_edges  accepts edges of length 0, between cells that meet in one point only
mesh::VoronoiMesh read_mesh_or_sites(Job& job, const CommonOptions& common,
                                     std::optional<double> radius, bool allow_zero_edges);

/// The kinds of files that OUTPUT may be.
enum class MeshOutputKind { mesh, mesh_or_sites, mesh_or_triangles };

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

/// Gives all nodes the same distance from the origin.
void set_radius(mesh::TriangleMesh& mesh, double radius);

/// Writes OUTPUT, and graph and report if they are wanted, and prints what was written.
void write_mesh(const MeshOutput& output, const mesh::VoronoiMesh& arrays, Job& job);

/// Does the same for sites that were made, from which a mesh is computed where one is wanted.
/// \param size  gives the densities of the mesh; null: 1 everywhere
/// \param how  the begin of the summary, such as "not converged after 10 steps; "
/// \param json  what the command adds to the report
void write_made(const MeshOutput& output, const std::vector<Point>& sites,
                const mesh::SizeFunction* size, const std::string& how, nlohmann::ordered_json json,
                Job& job);

/// Writes the report of 'rondel mesh quality' in the format of the path's ending: .svg is a
/// picture, .txt the printed text, anything else JSON.
void write_mesh_report(const std::string& path, const mesh::VoronoiMesh& arrays,
                       const mesh::Quality& quality, const Execution& execution);
/// Adds the option for the file of the report, which has the given names.
void add_mesh_report_option(CLI::App& parser, std::string& report,
                            const std::string& names = "--report");

}  // namespace rondel::cli
