// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh_output.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "process.h"
#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/names.h"
#include "triangle_output.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// Returns the format of meshes that a format of files or an ending means, or nothing.
std::optional<mesh::MeshFormat> mesh_format_of(const std::string& format) {
  if (format == "nc" || format == "nc4") return mesh::MeshFormat::mpas;
  if (format == "exo") return mesh::MeshFormat::exodus;
  return from_name<mesh::MeshFormat>(format);
}

// Checks the radius of the sphere of a mesh: squares of lengths must neither overflow nor vanish.
std::string radius_error(const std::string& text) {
  std::string error = positive_error(text);
  if (!error.empty()) return error;
  return range_error(text, mesh::min_radius, mesh::largest_radius);
}

// True if OUTPUT is triangles with coordinates x, y, z, whose length is the radius.
bool has_points(const CommonOptions& common) {
  const std::string format = common.format();
  return format == "msh" || format == "gmsh" || format == "gmsh2";
}

// True if OUTPUT is a mesh, and not sites.
bool is_mesh_file(const CommonOptions& common) {
  return mesh_format_of(common.format()).has_value();
}

// Returns the format that --format names, or the ending. Precondition: is_mesh_file().
mesh::MeshFormat mesh_format(const CommonOptions& common) {
  return mesh_format_of(common.format()).value();
}

// Writes graph and report if they are wanted, and OUTPUT if it is a mesh.
void write_mesh_files(const MeshOutput& output, const mesh::VoronoiMesh& arrays, Job& job) {
  const CommonOptions& common = output.common;
  job.time(Stage::write, [&] {
    if (!output.report.empty()) {
      write_mesh_report(output.report, arrays, mesh::quality(arrays, job.execution()),
                        job.execution());
    }
    if (!output.graph.empty()) mesh::write_graph(output.graph, arrays, job.execution());
    if (is_mesh_file(common)) {
      const NetcdfKind kind = common.format() == "nc4" ? NetcdfKind::netcdf4 : output.netcdf.kind;
      mesh::write(common.output, arrays, {mesh_format(common), kind, output.netcdf.deflate},
                  job.execution());
    }
  });
}

// Returns the mesh of sites that were made. The message of an error names the output, as no file
// has the sites.
mesh::VoronoiMesh arrays_of_made(const Triangulation& triangulation,
                                 const mesh::MeshOptions& options, const CommonOptions& common,
                                 const Job& job) {
  try {
    return mesh::make_mesh(triangulation, options, job.execution());
  } catch (const InvalidInput& error) {
    throw FileError(common.output + ": the mesh that was made: " + error.what());
  }
}

}  // namespace

// Sites get the mesh of their Voronoi cells; a mesh is scaled if a radius is given.
mesh::VoronoiMesh read_mesh_or_sites(Job& job, const CommonOptions& common,
                                     std::optional<double> radius, bool allow_zero_edges) {
  const mesh::MeshOptions options{.radius = radius.value_or(1),
                                  .allow_zero_edges = allow_zero_edges};
  mesh::VoronoiMesh arrays;
  if (is_netcdf_file(common.source())) {
    std::vector<std::string> remarks;
    job.time(Stage::dual, [&] {
      arrays = mesh::read_mesh(common.source(), options, job.execution(), &remarks);
    });
    tell(common.source().path, remarks);
    if (radius) mesh::rescale(arrays, *radius);
    return arrays;
  }
  const SiteTable table = job.read();
  const Triangulation triangulation = job.triangulate(table);
  job.time(Stage::dual, [&] {
    arrays = with_places(table,
                         [&] { return mesh::make_mesh(triangulation, options, job.execution()); });
  });
  return arrays;
}

void require_mesh_output(const MeshOutput& output, MeshOutputKind kind,
                         const std::vector<NamedFile>& inputs,
                         const std::vector<NamedFile>& outputs) {
  const CommonOptions& common = output.common;
  const bool may_be_sites = kind == MeshOutputKind::mesh_or_sites;
  const bool is_stream = common.output == "-";
  if (is_stream && (!may_be_sites || is_mesh_file(common))) {
    throw UsageError("--output: a mesh is written to a file, not to standard output");
  }
  std::string endings = may_be_sites ? ".csv .tsv .xyz .txt .npy" : "";
  if (!is_stream) {
    endings = ".nc .nc4 .exo (mpas ugrid scrip esmf exodus)" + (may_be_sites ? ' ' + endings : "");
  }
  if (kind == MeshOutputKind::mesh_or_triangles) {
    endings += ' ' + std::string(triangle_mesh_endings);
  }
  std::vector<NamedFile> written = {{"--report", output.report}, {"--graph", output.graph}};
  written.insert(written.end(), outputs.begin(), outputs.end());
  require_output(common, is_mesh_file(common) || (may_be_sites && can_write_sites(common.target())),
                 endings, inputs, written);
}

void write_mesh_report(const std::string& path, const mesh::VoronoiMesh& arrays,
                       const mesh::Quality& quality, const Execution& execution) {
  const std::string format = format_of(path);
  if (format == "svg") {
    write_file(path, mesh::quality_picture(arrays, quality, 100, execution));
  } else if (format == "txt") {
    write_file(path, mesh::quality_text(quality));
  } else {
    write_file(path, mesh::quality_json(quality));
  }
}

void write_mesh(const MeshOutput& output, const mesh::VoronoiMesh& arrays, Job& job) {
  write_mesh_files(output, arrays, job);
  const Seconds seconds = job.seconds();
  const nlohmann::ordered_json json = {{"cells", arrays.num_cells()},
                                       {"edges", arrays.num_edges()},
                                       {"vertices", arrays.num_vertices()},
                                       {"max_edges", arrays.max_edges()},
                                       {"seconds",
                                        {{"read", seconds.read},
                                         {"mesh", seconds.dual},
                                         {"write", seconds.write},
                                         {"total", seconds.total}}},
                                       {"peak_memory_bytes", peak_memory_bytes()}};
  job.report(json.dump(2) + '\n', count(arrays.num_cells(), "cell", "cells") + ", " +
                                      count(arrays.num_edges(), "edge", "edges") + ", " +
                                      count(arrays.num_vertices(), "vertex", "vertices") +
                                      "\nwrote the mesh to " + output.common.output + '\n');
}

void write_made(const MeshOutput& output, const std::vector<Point>& sites,
                const mesh::SizeFunction* size, const std::string& how, nlohmann::ordered_json json,
                Job& job) {
  const CommonOptions& common = output.common;
  nlohmann::ordered_json quality;  // null if no mesh is computed
  const bool wants_arrays = is_mesh_file(common) || !output.report.empty() || !output.graph.empty();
  if (wants_arrays) {
    std::vector<double> density;
    if (size != nullptr) {
      for (const Point& site : sites) density.push_back(size->density(site));
    }
    // Models that read MPAS meshes divide by lengths of edges; programs that only use cells do not.
    const bool is_for_model = is_mesh_file(common) && mesh_format(common) == mesh::MeshFormat::mpas;
    const mesh::MeshOptions options{
        .radius = output.radius.value_or(1), .density = density, .allow_zero_edges = !is_for_model};
    const Triangulation triangulation = delaunay(Sites::view(sites), {}, job.execution());
    const mesh::VoronoiMesh made = arrays_of_made(triangulation, options, common, job);
    quality =
        nlohmann::ordered_json::parse(mesh::quality_json(mesh::quality(made, job.execution())));
    write_mesh_files(output, made, job);
  }
  if (!is_mesh_file(common)) {
    job.time(Stage::write, [&] { write_sites(common.target(), sites, {}, {}, job.execution()); });
  }
  const Seconds seconds = job.seconds();
  json["cells"] = sites.size();
  if (!quality.is_null()) json["quality"] = std::move(quality);
  json["seconds"] = {{"write", seconds.write}, {"total", seconds.total}};
  job.report(json.dump(2) + '\n',
             how + "wrote " + count(sites.size(), "cell", "cells") + " to " + common.output + '\n');
}

void set_radius(mesh::TriangleMesh& mesh, double radius) {
  for (Point& p : mesh.points) {
    const double scale = radius / std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    p = {scale * p.x, scale * p.y, scale * p.z};
  }
}

void add_mesh_report_option(CLI::App& parser, std::string& report, const std::string& names) {
  parser
      .add_option(names, report,
                  "Where to write the report of 'rondel mesh quality': .svg draws histograms\n"
                  "and a map of the worst cells, or of triangles; .txt is the text, other "
                  "endings\nare JSON")
      ->type_name("FILE");
}

void add_mesh_output_options(CLI::App& parser, MeshOutput& output, MeshOutputKind kind) {
  const std::string of_meshes =
      "Where to write the mesh, netCDF: .nc and .nc4 are mpas (MPAS), .exo exodus; --format\n"
      "ugrid, scrip, esmf for the others";
  const std::string of_sites = ". Or its sites: .csv .tsv .xyz .txt .npy";
  const std::string of_triangles =
      ". Or triangles: .msh (Gmsh 4.1; --format gmsh2:\n2.2), .14 (ADCIRC), .gr3 .ll (SCHISM), "
      ".2dm "
      "(SMS), --format fesom (a folder)";
  add_output_option(parser, output.common,
                    of_meshes + (kind == MeshOutputKind::mesh            ? ""
                                 : kind == MeshOutputKind::mesh_or_sites ? of_sites
                                                                         : of_triangles))
      ->required();
  add_netcdf_options(parser, output.common, output.netcdf, [&output] {
    return is_mesh_file(output.common) ? std::vector<FileName>{output.common.target()}
                                       : std::vector<FileName>();
  });
  parser
      .add_option("--graph", output.graph,
                  "Where to write which cells are neighbors, for METIS: MPAS's graph.info")
      ->type_name("FILE");
  const CLI::Option* const radius =
      parser
          .add_option(
              "--sphere-radius", output.radius,
              "The radius of the sphere, in metres for most models (default: 1, or that of\n"
              "the mesh that is read)")
          ->check(radius_error)
          ->type_name("R");
  require_effect(
      output.common, radius,
      [&output] {
        return is_mesh_file(output.common) || !output.report.empty() || has_points(output.common);
      },
      kind == MeshOutputKind::mesh_or_triangles ? "on files in degrees"
                                                : "on sites, which are unit vectors");
  add_mesh_report_option(parser, output.report);
}

}  // namespace rondel::cli
