// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel buffer: the places within a distance of features.
// in    points, lines and polygons of GeoJSON, or sites of another format
// out   a polygon for each of them, with its columns; or one polygon
// index features, or sites, of INPUT
#include "rondel/buffer.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
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
#include "rondel/regions.h"
#include "rondel/set_operations.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel buffer`.
struct BufferCommand {
  CommonOptions common;
  double distance_km = 0;
  double tolerance_km = 0;  // 0: not given
  double radius_km = mean_earth_radius;
  bool is_dissolved = false;  // --dissolve
  PolygonOptions polygons;

  // Half of the tolerance is for the buffer, half for its lines in the file.
  [[nodiscard]] double half_tolerance() const {
    const double wanted = tolerance_km > 0 ? tolerance_km : std::abs(distance_km) / 1000;
    return wanted / radius_km / 2;
  }
  [[nodiscard]] double drawn_tolerance_deg() const {
    const double tolerance_deg = half_tolerance() * 180 / std::numbers::pi;
    return distance_km != 0 || tolerance_km > 0 ? tolerance_deg : 0.01;
  }
};

FeatureTable read_input(Job& job, const BufferCommand& options) {
  FeatureTable table = std::move(read_features_together(std::vector{options.common.source()},
                                                        options.polygons, job.execution())
                                     .front());
  tell(table.facts.name, table.facts.remarks);
  return table;
}

CellRings buffers_of(const FeatureTable& table, const BufferCommand& options,
                     const Execution& execution) {
  try {
    return buffered(table.lines, table.polygons,
                    {options.distance_km / options.radius_km, options.half_tolerance()}, execution);
  } catch (const InvalidInput& error) {
    const bool has_index = error.index() < table.lines.size();
    throw FileError(table.facts.name + ": " +
                    (has_index
                         ? "feature " + feature_name(table.facts.columns, error.index()) + ": "
                         : std::string()) +
                    error.what());
  }
}

// Throws FileError for files that cannot be read or written, UsageError.
ExitStatus run_buffer(const BufferCommand& options) {
  const CommonOptions& common = options.common;
  require_output(common, can_write_regions(common.target()), ".geojson .gpkg .fgb .parquet");
  require_region_writer(common.target());
  Job job(common);
  FeatureTable table;
  job.time(Stage::dual, [&] { table = read_input(job, options); });
  CellRings buffers;
  job.time(Stage::dual, [&] {
    buffers = buffers_of(table, options, job.execution());
    if (!options.is_dissolved) return;
    buffers = unite(buffers, job.execution());
    table.facts.columns.clear();
    table.ids = {};
  });
  job.time(Stage::write, [&] {
    write_regions(common.target(), buffers, table.facts.columns, options.drawn_tolerance_deg(),
                  job.execution(), table.ids, CellDrawing::apart);
  });
  const std::size_t number = num_not_empty(buffers);
  const double seconds = job.seconds().total;
  job.report(nlohmann::ordered_json{{"features", number}, {"seconds", seconds}}.dump(2) + '\n',
             "wrote " + count(number, "polygon", "polygons") + " to " + common.output + " in " +
                 text_of_seconds(seconds) + '\n');
  return done;
}

void add_distances(CLI::App& parser, BufferCommand& options) {
  parser
      .add_option("--distance", options.distance_km,
                  "How far the polygons reach from the features; negative: what remains of\n"
                  "polygons without the places so near to their border")
      ->check(finite_error)
      ->type_name("KM")
      ->required();
  parser
      .add_option("--tolerance", options.tolerance_km,
                  "How far the border of a polygon may be from the places at the distance\n"
                  "(default: a thousandth of it)")
      ->check(positive_error)
      ->type_name("KM");
  parser
      .add_option("--earth-radius", options.radius_km,
                  "The radius of the sphere (default: 6371.0088, the Earth's mean radius)")
      ->check(positive_error)
      ->type_name("KM");
}

}  // namespace

Command add_buffer_command(CLI::App& tool) {
  auto options = std::make_shared<BufferCommand>();
  CLI::App* parser =
      tool.add_subcommand("buffer", "Find the places within a distance of points, lines, polygons");
  add_input_file(
      *parser, "INPUT", options->common.input,
      "Points, lines and polygons: .geojson; or sites: .csv .tsv .xyz .txt .npy, with GDAL\n"
      "installed .gpkg .fgb .shp .parquet, the places of a netCDF file; or - for standard\n"
      "input, sites as CSV if no format is named")
      ->type_name("");
  parser
      ->add_option("--input-format", options->common.input_format,
                   "Format of INPUT: geojson csv tsv xyz txt npy")
      ->type_name("FORMAT");
  add_output_option(*parser, options->common,
                    "Where to write the polygons: .geojson; with GDAL installed .gpkg .fgb\n"
                    ".parquet")
      ->required();
  add_distances(*parser, *options);
  parser->add_flag("--dissolve", options->is_dissolved,
                   "Write one polygon: the union of all, without properties");
  add_edges_option(*parser, options->polygons.edges);
  add_invalid_option(*parser, options->polygons.invalid);
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  for (const char* const name : {"--edges", "--invalid"}) {
    require_effect(
        options->common, parser->get_option(name),
        [given = options.get()] { return may_have_features(given->common.source()); },
        "with INPUT of another format than geojson");
  }
  parser->footer(
      "Distances are along great circles. A polygon has the properties of its feature. It may go\n"
      "around a pole or across the antimeridian, where the file cuts it, and it may cover the\n"
      "whole sphere. Polygons of different features may overlap.\n\n"
      "Examples:\n"
      "  rondel buffer stations.csv --distance 300 -o around.geojson\n"
      "  rondel buffer rivers.geojson --distance 10 --dissolve -o near.geojson\n"
      "  rondel buffer countries.geojson --distance -50 -o inland.geojson");
  return {parser, [options] { return run_buffer(*options); }};
}

}  // namespace rondel::cli
