// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel mesh icosahedral: divides the faces of an icosahedron, and relaxes the sites.
// in    the number of divisions
// out   10 * 4^LEVELS + 2 sites on the unit sphere, or the mesh of their Voronoi cells
// index sites in the order in which the library makes them
#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "mesh_output.h"
#include "rondel/point_sets.h"
#include "rondel/scvt.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel mesh icosahedral`.
struct IcosahedralCommandOptions {
  MeshOutput output;
  unsigned levels = 0;
  bool keep = false;  // --no-relax
};

// Makes the sites, relaxed to a centroidal mesh unless --no-relax is given, and writes them.
ExitStatus run_icosahedral(const IcosahedralCommandOptions& options) {
  require_mesh_output(options.output, MeshOutputKind::mesh_or_sites);
  Job job(options.output.common);
  // Each division makes four faces of one, and a triangulation with n vertices has 2 n - 4 faces;
  // the icosahedron has 20.
  const std::size_t count = (std::size_t{10} << (2 * options.levels)) + 2;
  const std::vector<Point> sites = options.keep
                                       ? mesh::icosahedral_points(options.levels, job.execution())
                                       : mesh::scvt({.count = count}, job.execution()).sites;
  write_made(options.output, sites, nullptr, "", {{"levels", options.levels}}, job);
  return done;
}

}  // namespace

Command add_mesh_icosahedral_command(CLI::App& group) {
  auto options = std::make_shared<IcosahedralCommandOptions>();
  CLI::App* parser =
      group.add_subcommand("icosahedral", "Make a mesh of a divided icosahedron, relaxed");
  parser->add_option("LEVELS", options->levels, "Divisions in four: 10 * 4^LEVELS + 2 cells")
      ->required()
      ->check([](const std::string& text) { return whole_error(text, 0, 12); })
      ->type_name("");
  parser->add_flag("--no-relax", options->keep, "Leave the sites in the middles of edges");
  add_mesh_output_options(*parser, options->output, MeshOutputKind::mesh_or_sites);
  add_threads_option(*parser, options->output.common);
  add_report_options(*parser, options->output.common);
  parser->footer("Example:\n  rondel mesh icosahedral 6 -o x1.40962.nc");
  return {parser, [options] { return run_icosahedral(*options); }};
}

}  // namespace rondel::cli
