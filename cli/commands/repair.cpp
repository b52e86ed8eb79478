// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel repair: polygons that are not valid become valid.
// in    features of a file
// out   the same features with valid polygons
// index features
#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "job.h"
#include "region_features.h"
#include "report.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "rondel/geometries.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel repair`.
struct RepairOptions {
  CommonOptions common;
  PolygonOptions read = {.invalid = InvalidPolygons::repair};
  double tolerance_deg = 0.01;
};

// Returns what was repaired, as JSON.
nlohmann::ordered_json repairs_of(const CellFacts& facts) {
  auto repairs = nlohmann::ordered_json::array();
  for (std::size_t f = 0; f < facts.faults.size(); ++f) {
    if (!facts.faults[f].empty()) repairs.push_back({{"feature", f}, {"fault", facts.faults[f]}});
  }
  return repairs;
}

// Throws FileError for files that cannot be read or written, UsageError.
ExitStatus run_repair(const RepairOptions& options) {
  const CommonOptions& common = options.common;
  require_output(common, can_write_regions(common.target()), ".geojson .gpkg .fgb .parquet");
  require_region_writer(common.target());
  Job job(common);
  FeatureTable table;
  Geometries geometries;
  job.time(Stage::dual, [&] {
    table = std::move(
        read_features_together(std::vector{common.source()}, options.read, job.execution())
            .front());
    tell(table.facts.name, table.facts.remarks);
    geometries = {std::move(table.lines), std::move(table.polygons)};
    const std::size_t num_empty = geometries.size() - num_not_empty(geometries);
    if (num_empty > 0 && common.format() != "geojson") {
      tell(table.facts.name,
           {"left out " + count(num_empty, "feature", "features") + " without a place"});
    }
  });
  job.time(Stage::write, [&] {
    write_geometries(common.target(), geometries, table.facts.columns, options.tolerance_deg,
                     job.execution(), table.ids, drawing_of(geometries.polygons, job.execution()));
  });
  const std::size_t size = geometries.size();
  const nlohmann::ordered_json repairs = repairs_of(table.facts);
  const double seconds = job.seconds().total;
  job.report(
      nlohmann::ordered_json{{"features", size}, {"repaired", repairs}, {"seconds", seconds}}.dump(
          2) +
          '\n',
      "repaired " + std::to_string(repairs.size()) + " of " + count(size, "feature", "features") +
          "\nwrote them to " + common.output + " in " + text_of_seconds(seconds) + '\n');
  return done;
}

}  // namespace

Command add_repair_command(CLI::App& tool) {
  auto options = std::make_shared<RepairOptions>();
  CLI::App* parser = tool.add_subcommand("repair", "Make polygons valid");
  add_feature_files(*parser, options->common);
  add_edges_option(*parser, options->read.edges);
  parser
      ->add_option("--tolerance", options->tolerance_deg,
                   "How far a line of OUTPUT may be from its great circle (default: 0.01)")
      ->check(positive_error)
      ->type_name("DEG");
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "A polygon has the places that an odd number of its rings' sides divides from the outside,\n"
      "and a feature is the union of its polygons: where sides cross they get a corner, spikes\n"
      "and rings without an area vanish, and a ring around a pole has the pole. Corners keep\n"
      "their longitudes and latitudes of up to 12 decimals, longer ones to the last bit but one.\n"
      "A side that is no great circle gets corners between its ends. Points and lines stay; a\n"
      "line that jumps more than 180 degrees of longitude goes the shorter way. Properties and\n"
      "ids stay, and a feature without a place has a null geometry, or is left out of files that\n"
      "GDAL writes. --json lists what was wrong with each feature.\n\n"
      "Examples:\n"
      "  rondel repair parcels.geojson -o valid.geojson\n"
      "  rondel repair parcels.geojson -o valid.gpkg --json");
  return {parser, [options] { return run_repair(*options); }};
}

}  // namespace rondel::cli
