// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel contours writes isolines and bands of a column.
// in    sites with a column of values, and levels as a list or a step
// out   GeoJSON: a feature for each level (lines) or for each interval between levels (polygons)
// index values are indexed by site, in the order of the input
#include "rondel/contours.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "column_values.h"
#include "job.h"
#include "levels.h"
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
  double tolerance_deg = 0.01;
};

// Returns the levels in increasing order, from the list of --levels or the multiples of --step.
std::vector<double> levels_for(const ContoursOptions& options, const std::vector<double>& values) {
  return options.step > 0 ? levels_at(options.step, values, "--step") : options.levels;
}

// Reads and triangulates the sites, traces the lines or polygons, and writes them. A site without a
// value takes part in the triangulation, but its triangles are left out. Throws UsageError before
// any work if no levels are given or the sites are weighted.
ExitStatus run_contours(const ContoursOptions& options) {
  CommonOptions common = options.common;
  require_output(common, common.format() == "geojson", ".geojson");
  if (options.levels.empty() && options.step == 0) {
    throw UsageError("--levels or --step is required (see rondel contours --help)");
  }
  if (common.build.model == Model::weighted) {
    throw UsageError("--model: weighted sites have no isolines");
  }
  // Values are in a column, which the reader would drop otherwise.
  common.read.keep_columns = true;
  Job job(common);
  const SiteTable table = job.read(common.source(), common.read, {&options.value, 1});
  const std::vector<double> given = column_values(table, options.value, "--value");
  const std::vector<double> levels = levels_for(options, given);
  const Triangulation triangulation = job.triangulate(table);
  const std::vector<double> values = job.shown_values(
      triangulation, given, options.value, "triangles without three values are left out");
  // Isolines and bands are traced and written by functions of different types, in the same stages.
  const auto run = [&](const auto& trace, const auto& write) {
    decltype(trace()) traced;
    job.time(Stage::dual, [&] { traced = with_places(table, trace); });
    job.time(Stage::write,
             [&] { write(common.target(), traced, options.tolerance_deg, job.execution()); });
  };
  if (options.has_bands) {
    run([&] { return bands(triangulation, values, levels, job.execution()); }, write_bands);
  } else {
    run([&] { return isolines(triangulation, values, levels, job.execution()); }, write_isolines);
  }
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
                  "The levels are the multiples of X between the least and the largest value")
      ->check(positive_error)
      ->excludes(levels)
      ->type_name("X");
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
  add_report_options(*parser, options->common);
  parser->footer(
      "Values are linear in each triangle that the center sees. An isoline has the property\n"
      "'level' and higher values to its left; a band has 'low' and 'high', null at the open\n"
      "ends, and the values from 'low' to below 'high'. Triangles with a site without a value\n"
      "are left out, which is told. Of sites in one place the first one that has a value "
      "counts.\n\n"
      "Examples:\n"
      "  rondel contours stations.csv --value temperature --step 5 -o isotherms.geojson\n"
      "  rondel contours stations.csv --value depth --levels 0,200,2000 --bands -o bands.geojson");
  return {parser, [options] { return run_contours(*options); }};
}

}  // namespace rondel::cli
