// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel mesh equal-area: finds weights of sites that give their cells prescribed areas.
// in    sites, and a column of wanted areas in any unit; without it all areas are equal
// out   weighted sites, as points x, y, z or as circles lon, lat, radius; a report on how it ended
// index sites in the order of the input
#include "rondel/mesh_equal_area.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "column_values.h"
#include "job.h"
#include "process.h"
#include "report.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel mesh equal-area`.
struct EqualAreaCommandOptions {
  CommonOptions common;
  std::string column;  // --area
  // --tolerance: the largest relative error of an area at which the solver stops.
  double tolerance = 1e-12;
};

// Shows a step of the solver for areas on the progress line.
void show(const mesh::EqualAreaStep& step, const mesh::EqualAreaOptions& options,
          const Execution& execution) {
  if (!execution.progress) return;
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "areas within %.2g, of %d steps", step.largest_error,
                options.max_steps);
  execution.progress(text.data(), static_cast<double>(step.step) / options.max_steps);
}

// Scales areas in any unit, as large or small as doubles can be, so that their sum is that of the
// sphere. The library names the site of an area that is not positive or no number.
void scale_to_sphere(std::vector<double>& areas) {
  double largest = 0;
  for (const double area : areas) {
    if (std::isfinite(area)) largest = std::max(largest, area);
  }
  if (!(largest > 0)) return;
  // Scaling by a power of two is exact and keeps the sum finite. An area that would underflow stays
  // positive, since the library takes 0 for an error.
  const int exponent = std::ilogb(largest);
  double sum = 0;
  for (double& area : areas) {
    const bool is_positive = area > 0;
    area = std::scalbn(area, -exponent);
    if (is_positive) area = std::max(area, std::numeric_limits<double>::min());
    if (std::isfinite(area)) sum += area;
  }
  for (double& area : areas) area *= 4 * std::numbers::pi / sum;
}

// Finds the weights, writes the weighted sites and reports. The sites of the last step are written
// also if the areas are not reached, or after Ctrl-C; the exit status is then `failed`, or
// FileError is thrown with the reason and the worst site.
ExitStatus run_equal_area(const EqualAreaCommandOptions& options) {
  CommonOptions common = options.common;
  require_output(common, can_write_sites(common.target()), ".csv .tsv .xyz .txt .npy");
  Job job(common);
  common.read.keep_columns = !options.column.empty();
  const SiteTable table = job.read(common.source(), common.read);
  std::vector<double> targets;
  if (!options.column.empty()) {
    targets = column_values(table, options.column, "--area");
    scale_to_sphere(targets);
  }
  Execution execution = job.execution();
  execution.stop = &interrupted_by_user();
  mesh::EqualAreaOptions rules{.tolerance = options.tolerance};
  rules.on_step = [&](const mesh::EqualAreaStep& step) { show(step, rules, execution); };
  const mesh::EqualArea made =
      with_places(table, [&] { return mesh::equal_area(table.sites, targets, rules, execution); });
  job.time(Stage::write, [&] {
    write_sites(common.target(), made.poles, table.positions,
                table.is_lonlat() ? made.radii_deg : std::vector<double>{}, job.execution());
  });
  // An area may be as near as doubles allow without being within the tolerance: that is a success.
  const bool is_whole =
      made.end == mesh::EqualAreaEnd::converged || made.end == mesh::EqualAreaEnd::rounded;
  const std::string end(mesh::name_of(made.end));
  const Seconds seconds = job.seconds();
  nlohmann::ordered_json json = {{"end", end},
                                 {"sites", made.poles.size()},
                                 {"steps", made.steps},
                                 {"largest_error", made.largest_error},
                                 {"seconds", {{"write", seconds.write}, {"total", seconds.total}}}};
  if (made.worst != no_index) json["worst"] = made.worst;
  if (!made.reason.empty()) json["reason"] = made.reason;
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "%s after %d steps, areas within %.2g; ", end.c_str(),
                made.steps, made.largest_error);
  std::string summary = text.data();
  if (!made.reason.empty()) summary += made.reason + "; ";
  if (!is_whole && made.worst != no_index) {
    summary += "the worst is that of " + table.where(made.worst) + "; ";
  }
  job.report(json.dump(2) + '\n', summary + "wrote " + count(made.poles.size(), "site", "sites") +
                                      " to " + common.output + '\n');
  if (made.end == mesh::EqualAreaEnd::rounded && made.largest_error > options.tolerance) {
    text = {};
    std::snprintf(text.data(), text.size(),
                  "areas are within %.2g, not within --tolerance %.2g: doubles allow no more",
                  made.largest_error, options.tolerance);
    tell(common.output, {text.data()});
  }
  if (is_whole) return done;
  if (common.json) return failed;
  throw FileError(common.input +
                  ": the areas are not reached: " + summary.substr(0, summary.size() - 2));
}

}  // namespace

Command add_mesh_equal_area_command(CLI::App& group) {
  auto options = std::make_shared<EqualAreaCommandOptions>();
  CLI::App* parser =
      group.add_subcommand("equal-area", "Give the cells of sites prescribed areas, by weights");
  add_input_options(*parser, options->common);
  add_output_option(*parser, options->common,
                    "The weighted sites: .csv .tsv (lon, lat, radius), .xyz .txt .npy")
      ->required();
  parser
      ->add_option("--area", options->column,
                   "Column with the areas in any unit (default: all equal)")
      ->type_name("COL");
  parser
      ->add_option("--tolerance", options->tolerance,
                   "The largest relative error of an area (default: 1e-12)")
      ->check(positive_error)
      ->type_name("T");
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "The weighted sites are read by --model weighted, and as circles by --radius radius.\n"
      "With Ctrl-C those of the last step are written, and the exit status is 1, as it is where\n"
      "no weights give the areas.\n\n"
      "Examples:\n"
      "  rondel mesh equal-area stations.csv -o equal.npy\n"
      "  rondel voronoi equal.npy --model weighted -o equal.geojson");
  return {parser, [options] { return run_equal_area(*options); }};
}

}  // namespace rondel::cli
