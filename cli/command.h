// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// A command of the tool: a file in commands/ with its options, its help, and a function that runs
/// when the command line has been parsed.
///
///     Command add_plot_command(CLI::App& tool) {
///       auto options = std::make_shared<PlotOptions>();   // holds a CommonOptions `common`
///       CLI::App* parser = tool.add_subcommand("plot", "...");
///       add_input_options(*parser, options->common); ...
///       return {parser, [options] { return run_plot(*options); }};
///     }
///
/// in    the command line
/// out   files, a report on standard output, remarks and errors on standard error, an exit status
#pragma once

#include <functional>
#include <stdexcept>

namespace CLI {  // NOLINT(readability-identifier-naming): not ours
class App;
}  // namespace CLI

namespace rondel::cli {

/// The exit status of the tool. An exception becomes one line on stderr, "rondel: <what>", and one
/// of these: FileError, InvalidInput, bad_alloc, anything else -> failed; UsageError -> usage.
enum ExitStatus : int { done = 0, failed = 1, usage = 2 };

/// The command line asks for something that the tool does not offer.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A command of the tool and what it does once the command line is parsed.
struct Command {
  CLI::App* parser = nullptr;
  std::function<ExitStatus()> run;
};

/// Each of these functions adds a command with its arguments and its help to the tool, or to
/// `rondel mesh`. It is in the file of its name.
Command add_delaunay_command(CLI::App& tool);
Command add_triangulate_command(CLI::App& tool);
Command add_voronoi_command(CLI::App& tool);
Command add_regions_command(CLI::App& tool);
Command add_overlay_command(CLI::App& tool);
Command add_repair_command(CLI::App& tool);
Command add_relate_command(CLI::App& tool);
Command add_buffer_command(CLI::App& tool);
Command add_simplify_command(CLI::App& tool);
Command add_hull_command(CLI::App& tool);
Command add_check_command(CLI::App& tool);
Command add_contours_command(CLI::App& tool);
Command add_graph_command(CLI::App& tool);
Command add_plot_command(CLI::App& tool);
Command add_generate_command(CLI::App& tool);
Command add_info_command(CLI::App& tool);
Command add_locate_command(CLI::App& tool);
Command add_nearest_command(CLI::App& tool);
Command add_interpolate_command(CLI::App& tool);
Command add_regrid_command(CLI::App& tool);
Command add_remap_command(CLI::App& tool);
Command add_apply_command(CLI::App& tool);
Command add_check_weights_command(CLI::App& tool);
Command add_mesh_command(CLI::App& tool);
Command add_completion_command(CLI::App& tool);
Command add_mesh_scvt_command(CLI::App& group);
Command add_mesh_triangles_command(CLI::App& group);
Command add_mesh_icosahedral_command(CLI::App& group);
Command add_mesh_points_command(CLI::App& group);
Command add_mesh_equal_area_command(CLI::App& group);
Command add_mesh_convert_command(CLI::App& group);
Command add_mesh_cull_command(CLI::App& group);
Command add_mesh_quality_command(CLI::App& group);

}  // namespace rondel::cli
