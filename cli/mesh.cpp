// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "mesh.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <unordered_map>

#include "mesh_make.h"
#include "validate.h"
#include "words.h"

namespace rondel::cli {
namespace {

const std::unordered_map<std::string, mesh::MeshFormat>& mesh_formats() {
  static const std::unordered_map<std::string, mesh::MeshFormat> formats = {
      {"nc", mesh::MeshFormat::mpas},     {"mpas", mesh::MeshFormat::mpas},
      {"ugrid", mesh::MeshFormat::ugrid}, {"scrip", mesh::MeshFormat::scrip},
      {"esmf", mesh::MeshFormat::esmf},   {"exodus", mesh::MeshFormat::exodus},
      {"exo", mesh::MeshFormat::exodus}};
  return formats;
}

}  // namespace

mesh::MeshArrays read_mesh_or_sites(Job& job, const CommonOptions& common,
                                    const mesh::MeshOptions& options) {
  CommonOptions named;
  named.output = common.input;
  named.output_format = common.input_format;
  mesh::MeshArrays arrays;
  if (named.format() == "nc") {
    job.time(Stage::dual,
             [&] { arrays = mesh::read_mesh(common.source(), options, job.execution()); });
    return arrays;
  }
  const SiteTable table = job.read();
  const Triangulation triangulation = job.triangulate(table);
  job.time(Stage::dual, [&] {
    arrays =
        with_places(table, [&] { return mesh::arrays(triangulation, options, job.execution()); });
  });
  return arrays;
}

void require_mesh_output(const CommonOptions& common) {
  require_output(common, mesh_formats().contains(common.format()),
                 ".nc .exo, mpas ugrid scrip esmf exodus");
}

void write_mesh(const CommonOptions& common, const mesh::MeshArrays& arrays, mesh::NetcdfKind kind,
                const Job& job) {
  mesh::write(common.output, arrays, {mesh_formats().at(common.format()), kind}, job.execution());
}

void add_mesh_output_options(CLI::App& parser, MeshConvertOptions& options) {
  add_output_option(parser, options.common,
                    "Where to write the mesh, netCDF: .nc is mpas (MPAS), .exo exodus; --format\n"
                    "ugrid, scrip, esmf for the others")
      ->required();
  add_word<mesh::NetcdfKind>(
      parser, "--kind", options.kind,
      {{"cdf5", mesh::NetcdfKind::cdf5}, {"cdf2", mesh::NetcdfKind::cdf2}},
      "The format of netCDF: cdf5 (default) or cdf2 (64-bit offset; less than 4 GiB a\n"
      "variable)");
  parser
      .add_option("--graph", options.graph,
                  "Where to write which cells are neighbors, for METIS: MPAS's graph.info")
      ->type_name("FILE");
  parser
      .add_option("--sphere-radius", options.radius,
                  "The radius of the sphere, in metres for most models (default: 1)")
      ->check(positive_error)
      ->type_name("R");
  parser
      .add_option("--report", options.report,
                  "Where to write the report of 'rondel mesh quality', as JSON")
      ->type_name("FILE");
}

Command add_mesh_command(CLI::App& tool) {
  CLI::App* const parser = tool.add_subcommand("mesh", "Make, judge and convert meshes of models");
  parser->require_subcommand(1);
  std::vector<Command> commands = add_mesh_making_commands(*parser);
  commands.push_back(add_mesh_convert_command(*parser));
  commands.push_back(add_mesh_cull_command(*parser));
  commands.push_back(add_mesh_quality_command(*parser));
  parser->footer("'rondel mesh COMMAND --help' explains a command.");
  return {parser, [commands] {
            const auto at = std::ranges::find_if(
                commands, [](const Command& command) { return command.parser->parsed(); });
            return at->run();
          }};
}

}  // namespace rondel::cli
