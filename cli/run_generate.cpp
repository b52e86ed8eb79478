// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel generate: sites of a named kind, the same bytes for the same options on every machine.
#include <nlohmann/json.hpp>

#include "inputs/kinds.h"
#include "point_set_kinds.h"
#include "report.h"
#include "run.h"

namespace rondel::cli {
namespace {

using inputs::Kind;
using inputs::Recipe;

// Checks that the options fit the kind: a number of sites, a grid, or an angle in degrees.
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

}  // namespace

ExitStatus run_generate(const GenerateOptions& options) {
  CommonOptions common = options.common;
  if (common.output == "-" && common.output_format.empty()) common.output_format = "csv";
  require_output(common, can_write_sites(common.target()), ".csv .tsv .xyz .txt .npy");
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

}  // namespace rondel::cli
