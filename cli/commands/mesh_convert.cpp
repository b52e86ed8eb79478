// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel mesh convert: writes the mesh of sites, or a mesh of another file, in a format of models.
// in    sites, or a mesh of netCDF: MPAS, UGRID, SCRIP, ESMF
// out   the mesh in the format of OUTPUT, and its graph and report where these are asked for
// index cells in the order of the input
#include <CLI/CLI.hpp>
#include <memory>

#include "mesh_output.h"

namespace rondel::cli {
namespace {

// The options of `rondel mesh convert`.
struct MeshConvertOptions {
  MeshOutput written;  // INPUT: sites or a mesh
  bool allow_zero_edges = false;
};

// Reads or computes the mesh and writes it. Throws FileError for sites on one circle, unless
// --allow-zero-edges is given, and for sites that do not surround the center.
ExitStatus run_mesh_convert(const MeshConvertOptions& options) {
  const MeshOutput& written = options.written;
  require_mesh_output(written, MeshOutputKind::mesh);
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
  add_input_options(*parser, written.common, mesh_input_help);
  add_mesh_output_options(*parser, written, MeshOutputKind::mesh);
  parser->add_flag(
      "--allow-zero-edges", options->allow_zero_edges,
      "Accept sites on one circle, whose cells meet in one point: in MPAS\n"
      "there are edges of length 0, and models divide by it; other formats have one corner");
  add_threads_option(*parser, written.common);
  add_report_options(*parser, written.common);
  parser->footer(
      "INPUT may be a mesh as well, netCDF: MPAS, or UGRID, SCRIP and ESMF, whose mesh is\n"
      "computed again from the centers of the cells, and at a border from their corners. Cells\n"
      "that the file masks are left out. Sites have to surround the center of the sphere, each in "
      "a place\n"
      "of its own.\n\n"
      "Examples:\n"
      "  rondel mesh convert sites.csv -o mesh.nc --graph graph.info --sphere-radius 6371229\n"
      "  rondel mesh convert sites.npy -o mesh.nc --format ugrid\n"
      "  rondel mesh convert mesh.nc -o mesh.exo");
  return {parser, [options] { return run_mesh_convert(*options); }};
}

}  // namespace rondel::cli
