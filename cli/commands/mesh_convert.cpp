// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel mesh convert: writes the mesh of sites, or a mesh of another file, in a format of models.
// in    sites, a mesh of netCDF: MPAS, UGRID, SCRIP, ESMF, or triangles in a format of ocean models
// out   the mesh in the format of OUTPUT, and its graph and report where these are asked for; of
//       triangles, triangles
// index cells, or nodes and triangles, in the order of the input
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "mesh_output.h"
#include "report.h"
#include "triangle_output.h"

namespace rondel::cli {
namespace {

// The options of `rondel mesh convert`.
struct MeshConvertOptions {
  MeshOutput written;  // INPUT: sites or a mesh
  bool allow_zero_edges = false;
  std::optional<double> least_depth;
};

// True if triangles are written: in a format of ocean models, or as netCDF where INPUT has triangles.
bool are_triangles(const CommonOptions& common) {
  return mesh::is_triangle_mesh_file(common.target()) || has_triangles_alone(common);
}

// Returns the Delaunay triangles of sites. Throws FileError if there are none.
mesh::TriangleMesh triangles_of_sites(const CommonOptions& common, Job& job) {
  const SiteTable table = job.read();
  const std::vector<double> depths = depths_of_sites(common, table);
  const Triangulation triangulation = job.triangulate(table);
  std::vector<Triple> solid;
  for (Index f = 0; f < triangulation.num_faces(); ++f) {
    if (!triangulation.is_ghost(f)) solid.push_back(triangulation.faces()[f]);
  }
  if (solid.empty()) throw FileError(common.input + ": the sites have no triangles");
  leave_out_flat_triangles(common, table.sites, table.positions, {}, common.input, solid);
  return with_places(table, [&] {
    return mesh::triangle_mesh(table.sites, table.positions, solid, std::nullopt, depths);
  });
}

// Reads triangles, or makes those of sites, and writes them. Throws FileError.
ExitStatus convert_triangles(MeshConvertOptions options) {
  const MeshOutput& written = options.written;
  const CommonOptions& common = written.common;
  options.written.common.read.keep_columns = true;
  require_output(common, mesh::can_write_triangle_mesh(common.target()),
                 std::string(triangle_mesh_endings) + " .nc ugrid", {},
                 {{"--report", written.report}, {"--graph", written.graph}});
  Job job(common);
  const bool is_mesh = is_triangle_input(common) || is_netcdf_file(common.source());
  mesh::TriangleMesh mesh =
      is_mesh ? read_triangles_of(common, job) : triangles_of_sites(common, job);
  if (written.radius) set_radius(mesh, *written.radius);
  require_least_depth(options.least_depth, common.input, mesh);
  write_triangles_of(common, written.netcdf, mesh, common.input, job);
  write_triangle_report(written.report, mesh);
  nlohmann::ordered_json json = json_of_triangles(mesh);
  const Seconds seconds = job.seconds();
  json["seconds"] = {{"write", seconds.write}, {"total", seconds.total}};
  job.report(json.dump(2) + '\n',
             text_of_triangles(mesh) + "\nwrote the mesh to " + common.output + '\n');
  return done;
}

// Reads or computes the mesh and writes it. Throws FileError for sites on one circle, unless
// --allow-zero-edges is given, and for sites that do not surround the center.
ExitStatus run_mesh_convert(const MeshConvertOptions& options) {
  const MeshOutput& written = options.written;
  if (are_triangles(written.common)) return convert_triangles(options);
  require_mesh_output(written, MeshOutputKind::mesh_or_triangles);
  Job job(written.common);
  const mesh::VoronoiMesh arrays =
      read_mesh_or_sites(job, written.common, written.radius, options.allow_zero_edges);
  write_mesh(written, arrays, job);
  return done;
}

}  // namespace

Command add_mesh_convert_command(CLI::App& group) {
  auto options = std::make_shared<MeshConvertOptions>();
  CLI::App* parser = group.add_subcommand("convert", "Write the mesh of sites, or of another file");
  MeshOutput& written = options->written;
  add_input_options(*parser, written.common, std::string(mesh_input_help) + triangle_input_help);
  add_mesh_output_options(*parser, written, MeshOutputKind::mesh_or_triangles);
  parser->add_flag(
      "--allow-zero-edges", options->allow_zero_edges,
      "Accept sites on one circle, whose cells meet in one point: in MPAS\n"
      "there are edges of length 0, and models divide by it; other formats have one corner");
  for (const char* name : {"--graph", "--allow-zero-edges"}) {
    require_effect(
        written.common, parser->get_option(name),
        [&written] { return !are_triangles(written.common); }, "on triangles");
  }
  require_effect(
      written.common, add_least_depth_option(*parser, options->least_depth),
      [&written] { return are_triangles(written.common); }, "on cells");
  add_threads_option(*parser, written.common);
  add_report_options(*parser, written.common);
  parser->footer(
      "INPUT may be a mesh as well, netCDF: MPAS, or UGRID, SCRIP and ESMF, whose mesh is\n"
      "computed again from the centers of the cells, and at a border from their corners. Cells\n"
      "that the file masks are left out. Sites have to surround the center of the sphere, each in "
      "a place\n"
      "of its own.\n\n"
      "Triangles stay what they are: nodes, triangles, depths, and the border in open, land and\n"
      "island segments. netCDF in and triangles out is UGRID, and so is .nc of triangles; sites "
      "get\n"
      "their Delaunay triangles, without those on the border that have no area in degrees, as on\n"
      "a meridian, and the depths of their column 'depth'.\n\n"
      "Examples:\n"
      "  rondel mesh convert sites.csv -o mesh.nc --graph graph.info --sphere-radius 6371229\n"
      "  rondel mesh convert sites.npy -o mesh.nc --format ugrid\n"
      "  rondel mesh convert mesh.nc -o mesh.exo\n"
      "  rondel mesh convert fort.14 -o hgrid.gr3\n"
      "  rondel mesh convert hgrid.gr3 --least-depth 5 -o mesh --format fesom");
  return {parser, [options] { return run_mesh_convert(*options); }};
}

}  // namespace rondel::cli
