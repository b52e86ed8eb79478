// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel overlay: set operations on polygons.
// in    polygons of one or two files
// out   pieces with the columns of both files; or one polygon
// index features of A, of B; pieces
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "job.h"
#include "region_features.h"
#include "report.h"
#include "rondel/error.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "rondel/set_operations.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel overlay`.
struct OverlayOptions {
  CommonOptions common;  // A; OUTPUT: the polygons
  std::string second;    // B; empty: there is one operand
  SetOperation how = SetOperation::unite;
  bool is_dissolved = false;  // --dissolve
  PolygonOptions read;
  double tolerance_deg = 0.01;

  [[nodiscard]] bool is_joined() const { return is_dissolved || second.empty(); }
};

// Returns these rows of all columns.
std::vector<Column> rows_of_all(const std::vector<Column>& columns,
                                const std::vector<Index>& rows) {
  std::vector<Column> result;
  result.reserve(columns.size());
  for (const Column& column : columns) result.push_back(rows_of(column, rows));
  return result;
}

// Returns the columns of both files, of which the second ones change their names where both have
// the same.
std::vector<Column> joined(std::vector<Column> first, std::vector<Column> second) {
  std::vector<std::string> names;
  names.reserve(first.size() + second.size());
  for (const Column& column : first) names.push_back(column.name);
  for (const Column& column : second) names.push_back(column.name);
  names = free_names(std::move(names));
  for (Column& column : second) first.push_back(std::move(column));
  for (std::size_t k = 0; k < first.size(); ++k) first[k].name = names[k];
  return first;
}

// The features to be written.
struct Pieces {
  CellRings rings;
  std::vector<Column> columns;
};

Pieces pieces_of(const CellTable& first, const CellTable& second, const OverlayOptions& options,
                 const Execution& execution) {
  if (options.is_joined()) {
    return {combine(first.cells, second.cells, options.how, execution), {}};
  }
  RegionPieces pieces = overlay_pieces(first.cells, second.cells, options.how, execution);
  return {std::move(pieces.rings), joined(rows_of_all(first.facts.columns, pieces.cells),
                                          rows_of_all(second.facts.columns, pieces.regions))};
}

// Throws FileError for files that cannot be read or written, UsageError.
ExitStatus run_overlay(const OverlayOptions& options) {
  const CommonOptions& common = options.common;
  require_output(common, can_write_regions(common.target()), ".geojson .gpkg .fgb .parquet",
                 {{"SECOND", options.second}});
  if (options.second.empty() && options.how != SetOperation::unite) {
    throw UsageError("--how " + word_of(name_of(options.how)) + " needs SECOND, a second file");
  }
  require_region_writer(common.target());
  Job job(common);
  CellTable first;
  CellTable second;
  Pieces pieces;
  job.time(Stage::dual, [&] {
    first = read_polygons(common.source_beside(options.second), options.read, job.execution());
    tell(first.facts.name, first.facts.remarks);
    if (options.second.empty()) return;
    second = read_polygons(common.other_source(options.second), options.read, job.execution());
    tell(second.facts.name, second.facts.remarks);
  });
  job.time(Stage::dual, [&] { pieces = pieces_of(first, second, options, job.execution()); });
  job.time(Stage::write, [&] {
    write_regions(common.target(), pieces.rings, pieces.columns, options.tolerance_deg,
                  job.execution(), {}, drawing_of(pieces.rings, job.execution()));
  });
  const std::size_t number = num_not_empty(pieces.rings);
  const double seconds = job.seconds().total;
  job.report(nlohmann::ordered_json{{"features", number}, {"seconds", seconds}}.dump(2) + '\n',
             "wrote " + count(number, "polygon", "polygons") + " to " + common.output + " in " +
                 text_of_seconds(seconds) + '\n');
  return done;
}

}  // namespace

Command add_overlay_command(CLI::App& tool) {
  auto options = std::make_shared<OverlayOptions>();
  CLI::App* parser =
      tool.add_subcommand("overlay", "Compute unions, intersections and differences of polygons");
  add_input_file(*parser, "INPUT", options->common.input,
                 "The polygons A: .geojson, or - for standard input")
      ->type_name("");
  add_input_file(*parser, "SECOND", options->second,
                 "The polygons B; without them the union of A is written")
      ->required(false)
      ->type_name("");
  add_polygon_format_option(*parser, options->common);
  add_output_option(*parser, options->common,
                    "Where to write the polygons: .geojson; with GDAL installed .gpkg .fgb\n"
                    ".parquet")
      ->required();
  add_word<SetOperation>(
      *parser, "--how", options->how, named_values<SetOperation>(),
      "union (default), intersection, difference (A without B), symmetric-difference\n"
      "(what is in one of A and B) or identity (A, divided by B)");
  parser->add_flag("--dissolve", options->is_dissolved,
                   "Write one polygon: the places of all pieces, without properties");
  add_word<PolygonEdges>(
      *parser, "--edges", options->read.edges, named_values<PolygonEdges>(),
      "What joins positions of the files: lonlat (default; straight in longitude and\n"
      "latitude, RFC 7946) or geodesic (great circles)");
  add_invalid_option(*parser, options->read.invalid);
  parser
      ->add_option("--tolerance", options->tolerance_deg,
                   "How far a line of OUTPUT may be from its great circle (default: 0.01)")
      ->check(positive_error)
      ->type_name("DEG");
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  require_effect(
      options->common, parser->get_option("--dissolve"),
      [given = options.get()] { return !given->second.empty(); },
      "without SECOND, as the union of INPUT is one polygon");
  parser->footer(
      "Each polygon of A is divided into its intersections with the polygons of B and what is\n"
      "in none of them, and the same for B; --how says which of these pieces are written. A\n"
      "piece has the properties of both polygons. Polygons of one file may overlap. Results are\n"
      "exact but for the rounding of places where sides cross, by less than 2 nanometers.\n\n"
      "Examples:\n"
      "  rondel overlay countries.geojson -o land.geojson\n"
      "  rondel overlay countries.geojson basins.geojson --how intersection -o parts.geojson\n"
      "  rondel overlay countries.geojson lakes.geojson --how difference -o dry.geojson");
  return {parser, [options] { return run_overlay(*options); }};
}

}  // namespace rondel::cli
