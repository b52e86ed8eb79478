// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel mesh: the commands that make, judge and convert meshes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "command.h"

namespace rondel::cli {

// Each of the commands below adds itself to `rondel mesh`; exactly one of them is parsed, and run()
// passes the call on to it.
Command add_mesh_command(CLI::App& tool) {
  CLI::App* const parser = tool.add_subcommand("mesh", "Make, judge and convert meshes of models");
  parser->require_subcommand(1);
  const std::vector<Command> commands = {
      add_mesh_scvt_command(*parser),        add_mesh_triangles_command(*parser),
      add_mesh_icosahedral_command(*parser), add_mesh_points_command(*parser),
      add_mesh_equal_area_command(*parser),  add_mesh_convert_command(*parser),
      add_mesh_cull_command(*parser),        add_mesh_quality_command(*parser)};
  for (const Command& command : commands) command.parser->group("Commands");
  parser->footer("'rondel mesh COMMAND --help' explains a command.");
  return {parser, [commands] {
            const auto at = std::ranges::find_if(
                commands, [](const Command& command) { return command.parser->parsed(); });
            return at->run();
          }};
}

}  // namespace rondel::cli
