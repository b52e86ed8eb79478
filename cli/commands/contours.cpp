// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel contours writes isolines and bands of a column.
// in    sites with a column of values, and levels as a list or a step
// out   GeoJSON: a feature for each level (lines) or for each interval between levels (polygons)
// index values are indexed by site, in the order of the input
#include "rondel/contours.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "column_values.h"
#include "job.h"
#include "levels.h"
#include "process.h"
#include "report.h"
#include "rondel/native_weights.h"
#include "rondel/read_cells.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of the command, each with its name on the command line.
struct ContoursOptions {
  CommonOptions common;
  std::string value;           // --value: a column
  std::vector<double> levels;  // --levels
  double step = 0;             // --step; 0: not given
  bool has_bands = false;      // --bands
  bool is_native = false;      // --method native
  std::string mesh;            // --source; empty: INPUT has the mesh
  double tolerance_deg = 0.01;
};

// Returns the levels in increasing order, from the list of --levels or the multiples of --step.
std::vector<double> levels_for(const ContoursOptions& options, const std::vector<double>& values) {
  return options.step > 0 ? levels_at(options.step, values, "--step") : options.levels;
}

// Traces and writes isolines or bands. `run` calls what traces with all that it needs. Isolines and
// bands are traced and written by functions of different types, in the same stages.
template <class Run>
void trace(Job& job, const ContoursOptions& options, const SiteTable& table, const Run& run) {
  const auto trace_and_write = [&](const auto& contours, const auto& write) {
    decltype(run(contours)) traced;
    job.time(Stage::dual, [&] { traced = with_places(table, [&] { return run(contours); }); });
    job.time(Stage::write, [&] {
      write(options.common.target(), traced, options.tolerance_deg, job.execution());
    });
  };
  if (options.has_bands) {
    trace_and_write([](const auto&... all) { return bands(all...); }, write_bands);
  } else {
    trace_and_write([](const auto&... all) { return isolines(all...); }, write_isolines);
  }
}

// Returns the cells of the mesh around the sites of INPUT, and tells what is left out.
CellRings cells_of_mesh(Job& job, const ContoursOptions& options, const SiteTable& table) {
  const FileName file = options.common.source();
  NativeCells native;
  if (!options.mesh.empty()) {
    native = read_native_cells(options.mesh, table.positions);
  } else if (file_and_variable(file).second.empty()) {
    // The variable says which mesh it is on, where a file has several. The name of one of its fields,
    // "tas[3]", begins with its own; other names of fields, "tas_2001-07-15", name no variable.
    FileName named = file;
    named.path += ':' + options.value.substr(0, options.value.find('['));
    try {
      native = read_native_cells(named, table.positions);
    } catch (const FileError&) {
      native = read_native_cells(file, table.positions);
    }
  } else {
    native = read_native_cells(file, table.positions);
  }
  for (const std::string& remark : native.remarks) job.remark(table.name, remark);
  return std::move(native.cells);
}

// Traces in the cells of the mesh, of which sites that are masked have no value.
ExitStatus run_in_cells(Job& job, const ContoursOptions& options) {
  const std::string path = file_and_variable(options.common.source()).first.path;
  if (path == "-" || !is_netcdf_file({path, {}})) {
    throw FileError((path == "-" ? "<stdin>" : path) +
                    ": --method native needs a file of netCDF with a mesh");
  }
  const NetcdfSites grid = job.read_on_mesh(options.common.source(), options.mesh,
                                            options.common.read, {&options.value, 1});
  const SiteTable& table = grid.table;
  std::vector<double> values = column_values(table, options.value, "--value");
  const std::vector<bool> takes_part = grid.unmasked();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!takes_part[i]) values[i] = std::numeric_limits<double>::quiet_NaN();
  }
  const std::vector<double> levels = levels_for(options, values);
  const CellRings cells = cells_of_mesh(job, options, table);
  const auto num_without =
      std::ranges::count_if(values, [](double value) { return std::isnan(value); });
  const std::string of_all = " of " + count(values.size(), "site", "sites");
  if (num_without > 0) {
    job.remark(table.name, std::to_string(num_without) + of_all +
                               (num_without == 1 ? " has" : " have") + " no value of '" +
                               options.value + "': cells without all values are left out");
  }
  trace(job, options, table, [&](const auto& contours) {
    try {
      return contours(cells, values, levels, job.execution());
    } catch (const InvalidInput& error) {
      throw FileError(table.name + ": " +
                      error.what());  // its index is that of a cell, not of a row
    }
  });
  const Seconds seconds = job.seconds();
  const nlohmann::ordered_json json = {{"sites", values.size()},
                                       {"cells", cells.num_cells()},
                                       {"without_value", num_without},
                                       {"seconds",
                                        {{"read", seconds.read},
                                         {"dual", seconds.dual},
                                         {"write", seconds.write},
                                         {"total", seconds.total}}},
                                       {"peak_memory_bytes", peak_memory_bytes()}};
  job.report(json.dump(2) + '\n', count(values.size(), "site", "sites") + ", " +
                                      count(cells.num_cells(), "cell", "cells") +
                                      " of the mesh\nwrote " +
                                      (options.has_bands ? "the bands" : "the isolines") + " to " +
                                      options.common.output + '\n');
  return done;
}

// Reads and triangulates the sites, traces the lines or polygons, and writes them. A site without a
// value takes part in the triangulation, but its triangles are left out. Throws UsageError before
// any work if no levels are given or the sites are weighted.
ExitStatus run_contours(const ContoursOptions& options) {
  CommonOptions common = options.common;
  require_output(common, common.format() == "geojson", ".geojson", {{"--source", options.mesh}});
  if (options.levels.empty() && options.step == 0) {
    throw UsageError("--levels or --step is required (see rondel contours --help)");
  }
  if (common.build.model == Model::weighted) {
    throw UsageError("--model: weighted sites have no isolines");
  }
  // Values are in a column, which the reader would drop otherwise.
  common.read.keep_columns = true;
  Job job(common);
  if (options.is_native) return run_in_cells(job, options);
  const SiteTable table = job.read(common.source(), common.read, {&options.value, 1});
  const std::vector<double> given = column_values(table, options.value, "--value");
  const std::vector<double> levels = levels_for(options, given);
  const Triangulation triangulation = job.triangulate(table);
  const std::vector<double> values = job.shown_values(
      triangulation, given, options.value, "triangles without three values are left out");
  trace(job, options, table, [&](const auto& contours) {
    return contours(triangulation, values, levels, job.execution());
  });
  job.report(triangulation, options.has_bands ? "the bands" : "the isolines");
  return done;
}

// Adds the options that say which column is contoured, at which levels, and how.
void add_level_options(CLI::App& parser, ContoursOptions& options) {
  parser
      .add_option("--value", options.value,
                  "The column with the values; an empty cell has none. Of netCDF a variable, of\n"
                  "one with several times 'NAME[3]', 'NAME[-1]' or NAME_2001-07-15")
      ->required()
      ->type_name("COL");
  CLI::Option* levels =
      parser
          .add_option_function<std::string>(
              "--levels", [&options](const std::string& text) { options.levels = levels_of(text); },
              "The levels, increasing, with commas between them: 0,5,10")
          ->check(levels_error)
          ->type_name("LIST");
  parser
      .add_option("--step", options.step,
                  "The levels are the multiples of X above the least value, up to the largest one")
      ->check(positive_error)
      ->excludes(levels)
      ->type_name("X");
  parser
      .add_option_function<std::string>(
          "--method", [&options](const std::string& text) { options.is_native = text == "native"; },
          "linear in the triangles of the sites (default), or native in the cells of the mesh\n"
          "of netCDF whose nodes or centers the sites are")
      ->check(one_of({"linear", "native"}))
      ->type_name("METHOD");
  CLI::Option* const mesh =
      parser
          .add_option("--source", options.mesh,
                      "Where INPUT has no mesh: netCDF with the mesh at whose nodes or cells the\n"
                      "values are")
          ->type_name("FILE");
  require_effect(
      options.common, mesh, [&options] { return options.is_native; }, "without --method native");
  parser.add_flag("--bands", options.has_bands, "The regions between the levels instead of lines");
  parser
      .add_option("--tolerance", options.tolerance_deg,
                  "How far a line may be from its great circle (default: 0.01)")
      ->check(positive_error)
      ->type_name("DEG");
}

}  // namespace

Command add_contours_command(CLI::App& tool) {
  const auto options = std::make_shared<ContoursOptions>();
  CLI::App* parser =
      tool.add_subcommand("contours", "Draw isolines or bands of values at the sites");
  add_input_options(*parser, options->common);
  add_output_option(*parser, options->common, "Where to write them: .geojson, a feature a level")
      ->required();
  add_level_options(*parser, *options);
  add_build_options(*parser, options->common);
  for (const char* const name : {"--model", "--center"}) {
    require_effect(
        options->common, parser->get_option(name),
        [given = options.get()] { return !given->is_native; }, "with --method native");
  }
  add_report_options(*parser, options->common);
  parser->footer(
      "Values are linear in each triangle that the center sees. An isoline has the property\n"
      "'level' and higher values to its left; a band has 'low' and 'high', null at the open\n"
      "ends, and the values from 'low' to below 'high'. Triangles with a site without a value\n"
      "are left out, which is told. Of sites in one place the first one that has a value "
      "counts.\n"
      "With --method native nothing is triangulated: values at the nodes of a mesh (UGRID, MPAS,\n"
      "ICON, ESMF, Exodus) are contoured in its faces, those of faces in the cells that join\n"
      "their centers, so that no line crosses land. Cells of more than three corners are divided\n"
      "from their middle. Models that keep the mesh in a file of its own write values without\n"
      "places: --source names that file, and the last dimension of the values says whether they\n"
      "are at its nodes or its cells.\n\n"
      "Examples:\n"
      "  rondel contours stations.csv --value temperature --step 5 -o isotherms.geojson\n"
      "  rondel contours stations.csv --value depth --levels 0,200,2000 --bands -o bands.geojson\n"
      "  rondel contours waves.nc --value height --step 1 --method native -o heights.geojson\n"
      "  rondel contours run.nc --value ssh[1] --step 0.5 --method native --source mesh.nc \\\n"
      "      -o ssh.geojson");
  return {parser, [options] { return run_contours(*options); }};
}

}  // namespace rondel::cli
