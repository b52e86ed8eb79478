// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel generate: sites of a named kind, the same bytes for the same options on every machine.
// in    the name of a kind, a number of sites, a seed
// out   sites as points x, y, z, as longitudes and latitudes, or as circles with a radius in
//       degrees
// index sites in the order in which the kind makes them
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "inputs/kinds.h"
#include "job.h"
#include "point_set_kinds.h"
#include "report.h"
#include "validate.h"

namespace rondel::cli {
namespace {

using inputs::Kind;
using inputs::Recipe;

// The options of `rondel generate`.
struct GenerateOptions {
  CommonOptions common;
  // KIND; find_kind() knows it, as the parser has checked.
  std::string kind;
  Recipe recipe;
  double angle = 0;  // in the unit of the command line; 0: the kind's own
};

// Checks that the options fit the kind: a number of sites, a grid, or an angle in degrees.
// Throws UsageError, which names the option.
void require_parts(const Kind& kind, const Recipe& recipe) {
  const std::string name(kind.name);
  const bool has_grid = recipe.rows > 0;
  if (has_grid && name != "lonlat-grid") {
    throw UsageError("--rows and --columns are for lonlat-grid, not for " + name);
  }
  if (recipe.angle_deg > 0 && kind.angle_deg == 0) {
    throw UsageError("--angle: " + name + " has no angle");
  }
  if ((name == "circles" || name == "cap") && recipe.angle_deg >= 90) {
    throw UsageError("--angle: " + name + ": less than 90 degrees");
  }
  if (recipe.angle_deg > 180) throw UsageError("--angle is more than half a turn");
  if (name == "poisson") {
    if (recipe.n > 0) throw UsageError("-n,--number: poisson takes --angle instead");
    return;
  }
  if (!has_grid && recipe.n == 0) throw UsageError("-n,--number is required");
  if (has_grid && recipe.rows > max_sites / recipe.columns) {
    throw UsageError("--rows times --columns is more than " + std::to_string(max_sites));
  }
}

// Makes the sites and writes them; a table on standard output is CSV by default. Throws UsageError
// for options that do not fit the kind.
ExitStatus run_generate(const GenerateOptions& options) {
  CommonOptions common = options.common;
  if (common.output == "-" && common.output_format.empty()) common.output_format = "csv";
  require_output(common, can_write_sites(common.target()),
                 ".csv .tsv .xyz .txt .npy .gpkg .fgb .parquet");
  const Kind& kind = *find_kind(options.kind);
  Recipe recipe = options.recipe;
  recipe.angle_deg =
      common.read.radians ? options.angle * inputs::degrees_per_radian : options.angle;
  require_parts(kind, recipe);
  Job job(common);
  const inputs::Input made = make(kind, recipe);
  job.time(Stage::write, [&] {
    write_sites(common.target(), made.sites, made.positions, made.radii_deg, job.execution());
  });
  const Seconds seconds = job.seconds();
  const nlohmann::ordered_json json = {
      {"kind", options.kind},
      {"sites", made.sites.size()},
      {"seed", recipe.seed},
      {"seconds", {{"write", seconds.write}, {"total", seconds.total}}}};
  job.report(json.dump(2) + '\n',
             "wrote " + count(made.sites.size(), "site", "sites") + " to " + common.output + '\n');
  return done;
}

// Returns the names of all kinds.
std::vector<std::string> names_of_kinds() {
  std::vector<std::string> names;
  for (const std::span<const inputs::Kind> kinds :
       {inputs::plain_kinds(), point_set_kinds(), inputs::hostile_kinds()}) {
    for (const inputs::Kind& kind : kinds) names.emplace_back(kind.name);
  }
  return names;
}

// Returns the table of kinds for the help of `rondel generate`, a line for each kind.
std::string kinds_help() {
  const auto list = [](std::span<const inputs::Kind> kinds) {
    std::string text;
    for (const inputs::Kind& kind : kinds) {
      std::string name(kind.name);
      name.resize(18, ' ');
      text += "  " + name + std::string(kind.what) + '\n';
    }
    return text;
  };
  return "Kinds:\n" + list(inputs::plain_kinds()) + "\nSets of known numbers of sites:\n" +
         list(point_set_kinds()) +
         "\nHostile kinds, which cost some algorithms much time or many digits:\n" +
         list(inputs::hostile_kinds());
}

}  // namespace

Command add_generate_command(CLI::App& tool) {
  auto options = std::make_shared<GenerateOptions>();
  CLI::App* parser = tool.add_subcommand("generate", "Generate sites to try things out");
  inputs::Recipe& recipe = options->recipe;
  parser->add_option("KIND", options->kind, "What to generate: see below")
      ->required()
      ->check(one_of(names_of_kinds(), "is not a kind"))
      ->type_name("");
  CLI::Option* number = parser->add_option("-n,--number", recipe.n, "Number of sites, also as 1e6");
  number->check(count_error)->transform(digits_of_whole)->type_name("N");
  add_output_option(
      *parser, options->common,
      "Where to write the sites: .csv .tsv (with a header), .xyz .txt .npy; with GDAL\n"
      "installed .gpkg .fgb .parquet")
      ->required();
  CLI::Option* seed =
      parser->add_option("--seed", recipe.seed, "Seed of the random numbers (default: 1)");
  seed->check(seed_error)->type_name("S");
  require_effect(
      options->common, seed, [given = options.get()] { return find_kind(given->kind)->is_random; },
      "on sites that are not random");
  CLI::Option* angle = parser->add_option("--angle", options->angle,
                                          "Angular radius of patch, cluster, cap and\n"
                                          "small-circle, largest one of circles, width of wedge,\n"
                                          "least distance of poisson");
  angle->check(positive_error)->type_name("DEG");
  parser->add_flag("--radians", options->common.read.radians, "--angle is in radians")
      ->needs(angle);
  CLI::Option* rows = parser->add_option("--rows", recipe.rows, "lonlat-grid: number of parallels");
  CLI::Option* columns =
      parser->add_option("--columns", recipe.columns, "lonlat-grid: number of meridians");
  for (CLI::Option* option : {rows, columns}) {
    option->check(count_error)->transform(digits_of_whole)->type_name("N");
  }
  // A grid is given by the numbers of its rows and columns, or by -n, which chooses them.
  rows->needs(columns)->excludes(number);
  columns->needs(rows);
  add_report_options(*parser, options->common);
  parser->footer(kinds_help() +
                 "\nThe same seed gives the same bytes on every machine.\n\n"
                 "Examples:\n"
                 "  rondel generate uniform -n 100000 -o sites.npy\n"
                 "  rondel generate circles -n 1000 --angle 20 -o circles.csv\n"
                 "  rondel generate patch -n 1000 --angle 0.01 --seed 7 -o patch.csv");
  return {parser, [options] { return run_generate(*options); }};
}

}  // namespace rondel::cli
