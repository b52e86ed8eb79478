// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel simplify: lines and polygons with fewer corners.
// in    features of a file
// out   the same features, within a distance of what they were
// index features
#include "rondel/simplify.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "job.h"
#include "region_features.h"
#include "report.h"
#include "rondel/feature_cells.h"
#include "rondel/geometries.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel simplify`.
struct SimplifyCommand {
  CommonOptions common;
  double tolerance_km = 0;
  double radius_km = mean_earth_radius;
  SimplifyOptions simplify;
  PolygonOptions polygons;

  // A sixteenth of the tolerance is for lines of INPUT that become arcs, another one for arcs that
  // become lines of OUTPUT.
  [[nodiscard]] double share() const { return tolerance_km / radius_km / 16; }
  [[nodiscard]] double share_deg() const { return share() * 180 / std::numbers::pi; }
};

// Throws FileError for files that cannot be read or written, UsageError.
ExitStatus run_simplify(SimplifyCommand options) {
  const CommonOptions& common = options.common;
  require_output(common, can_write_regions(common.target()), ".geojson .gpkg .fgb .parquet");
  require_region_writer(common.target());
  options.polygons.tolerance_deg = std::min(options.polygons.tolerance_deg, options.share_deg());
  options.simplify.tolerance = 14 * options.share();
  Job job(common);
  FeatureTable table;
  Geometries simple;
  job.time(Stage::dual, [&] {
    table = std::move(
        read_features_together(std::vector{common.source()}, options.polygons, job.execution())
            .front());
    tell(table.facts.name, table.facts.remarks);
    SimplifiedFeatures features =
        simplified(table.lines, table.polygons, options.simplify, job.execution());
    simple = {std::move(features.lines), std::move(features.polygons)};
  });
  const std::size_t num_vanished =
      num_not_empty(Geometries{table.lines, table.polygons}) - num_not_empty(simple);
  if (num_vanished > 0) {
    tell(table.facts.name, {"nothing is left of " + count(num_vanished, "feature", "features") +
                            " whose rings are smaller than the tolerance"});
  }
  job.time(Stage::write, [&] {
    write_geometries(common.target(), simple, table.facts.columns,
                     std::min(0.01, options.share_deg()), job.execution(), table.ids,
                     drawing_of(simple.polygons, job.execution()));
  });
  const std::size_t number = num_not_empty(simple);
  const auto num_corners = [](const FeatureLines& lines, const CellRings& polygons) {
    return lines.rows.values.size() + polygons.corners.size();
  };
  const std::size_t before = num_corners(table.lines, table.polygons);
  const std::size_t after = num_corners(simple.lines, simple.polygons);
  const double seconds = job.seconds().total;
  job.report(nlohmann::ordered_json{{"features", number},
                                    {"corners", after},
                                    {"corners_before", before},
                                    {"seconds", seconds}}
                     .dump(2) +
                 '\n',
             "kept " + std::to_string(after) + " of " + count(before, "corner", "corners") +
                 "\nwrote " + count(number, "feature", "features") + " to " + common.output +
                 " in " + text_of_seconds(seconds) + '\n');
  return done;
}

}  // namespace

Command add_simplify_command(CLI::App& tool) {
  auto options = std::make_shared<SimplifyCommand>();
  CLI::App* parser =
      tool.add_subcommand("simplify", "Remove corners of lines and polygons within a distance");
  add_feature_files(*parser, options->common);
  parser
      ->add_option("--tolerance", options->tolerance_km,
                   "How far lines of OUTPUT may be from those of INPUT that they replace")
      ->check(positive_error)
      ->type_name("KM")
      ->required();
  parser
      ->add_option("--earth-radius", options->radius_km,
                   "The radius of the sphere (default: 6371.0088, the Earth's mean radius)")
      ->check(positive_error)
      ->type_name("KM");
  parser->add_flag("--drop-small", options->simplify.drop_small,
                   "Remove rings that are nowhere wider than the tolerance (default: they keep\n"
                   "three corners)");
  parser->add_flag("--keep-boundary", options->simplify.keep_boundary,
                   "Keep the corners that are on a ring of one polygon alone");
  add_edges_option(*parser, options->polygons.edges);
  add_invalid_option(*parser, options->polygons.invalid);
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "All features are simplified together: a border that two of them share stays common to\n"
      "them, without gaps and overlaps, and corners where three meet stay. No ring or line "
      "crosses\n"
      "itself or another one that it did not cross before, no ring turns around or vanishes, and\n"
      "holes stay in their polygons. Points and the ends of lines stay. Corners of OUTPUT are\n"
      "corners of INPUT, but for those that lines along great circles get in longitude and\n"
      "latitude. Distances are along great circles. Properties and ids stay; a feature of which\n"
      "nothing is left has a null geometry.\n\n"
      "Examples:\n"
      "  rondel simplify countries.geojson --tolerance 5 -o few.geojson\n"
      "  rondel simplify rivers.geojson --tolerance 2 -o rivers_few.geojson\n"
      "  rondel simplify islands.geojson --tolerance 1 --drop-small -o large.geojson");
  return {parser, [options] { return run_simplify(*options); }};
}

}  // namespace rondel::cli
