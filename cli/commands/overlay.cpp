// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel overlay: set operations on points, lines and polygons.
// in    features of one or two files
// out   pieces with the columns of both files; or one feature
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
#include "rondel/geometries.h"
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
  bool has_touching = false;  // --touching
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
  Geometries geometries;
  std::vector<Column> columns;
  std::size_t num_left_out = 0;  // lines and points in which features only meet
};

bool has_lines(const Geometries& geometries) { return geometries.lines.rows.size() > 0; }

// Returns groups of lines, none of which has a line.
Geometries without_lines(CellRings rings) {
  Geometries geometries;
  for (std::size_t i = 0; i < rings.num_cells(); ++i) geometries.lines.end_group();
  geometries.polygons = std::move(rings);
  return geometries;
}

// Returns the union, or another combination, of all features.
Pieces combined(const Geometries& first, const Geometries& second, const OverlayOptions& options,
                const Execution& execution) {
  if (!has_lines(first) && !has_lines(second) && !options.has_touching) {
    return {without_lines(combine(first.polygons, second.polygons, options.how, execution)), {}};
  }
  Geometries all = combine(first, second, options.how, execution);
  if (options.has_touching) return {std::move(all), {}};
  Geometries proper = without_touching_parts(all, first, second);
  const std::size_t num_left_out = all.lines.rows.size() - proper.lines.rows.size();
  return {std::move(proper), {}, num_left_out};
}

// Returns the pieces into which the features divide each other.
Pieces divided(const Geometries& first, const Geometries& second, const FeatureTable& of_first,
               const FeatureTable& of_second, const OverlayOptions& options,
               const Execution& execution) {
  const auto with_columns = [&](Geometries geometries, const std::vector<Index>& a,
                                const std::vector<Index>& b) {
    return Pieces{std::move(geometries), joined(rows_of_all(of_first.facts.columns, a),
                                                rows_of_all(of_second.facts.columns, b))};
  };
  if (!has_lines(first) && !has_lines(second) && !options.has_touching) {
    RegionPieces pieces = overlay_pieces(first.polygons, second.polygons, options.how, execution);
    return with_columns(without_lines(std::move(pieces.rings)), pieces.cells, pieces.regions);
  }
  GeometryPieces pieces = overlay_pieces(first, second, options.how, execution);
  const std::size_t num_lines = pieces.pieces.lines.rows.size();
  if (!options.has_touching) pieces = without_touching_parts(pieces, first, second);
  const std::size_t num_left_out = num_lines - pieces.pieces.lines.rows.size();
  Pieces result = with_columns(std::move(pieces.pieces), pieces.first, pieces.second);
  result.num_left_out = num_left_out;
  return result;
}

// Reads the features of both files, if there are two. Throws FileError.
std::vector<FeatureTable> read_operands(const OverlayOptions& options, const Execution& execution) {
  std::vector<FileName> files = {options.common.source_beside(options.second)};
  if (!options.second.empty()) files.push_back(options.common.other_source(options.second));
  std::vector<FeatureTable> tables = read_features_together(files, options.read, execution);
  for (const FeatureTable& table : tables) tell(table.facts.name, table.facts.remarks);
  tables.resize(2);
  return tables;
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
  Pieces pieces;
  job.time(Stage::dual, [&] {
    std::vector<FeatureTable> tables = read_operands(options, job.execution());
    const auto taken = [](FeatureTable& table) {
      return Geometries{std::move(table.lines), std::move(table.polygons)};
    };
    const Geometries first = taken(tables.front());
    const Geometries second = taken(tables.back());
    pieces = options.is_joined()
                 ? combined(first, second, options, job.execution())
                 : divided(first, second, tables.front(), tables.back(), options, job.execution());
  });
  if (pieces.num_left_out > 0) {
    tell(common.output,
         {"left out " + count(pieces.num_left_out, "line or point", "lines and points") +
          " in which features only meet; --touching writes them"});
  }
  const Geometries& geometries = pieces.geometries;
  job.time(Stage::write, [&] {
    const CellDrawing drawing = drawing_of(geometries.polygons, job.execution());
    if (has_lines(geometries)) {
      write_geometries(common.target(), geometries, pieces.columns, options.tolerance_deg,
                       job.execution(), {}, drawing);
    } else {
      write_regions(common.target(), geometries.polygons, pieces.columns, options.tolerance_deg,
                    job.execution(), {}, drawing);
    }
  });
  const std::size_t number = num_not_empty(geometries);
  const double seconds = job.seconds().total;
  job.report(nlohmann::ordered_json{{"features", number}, {"seconds", seconds}}.dump(2) + '\n',
             "wrote " + count(number, "feature", "features") + " to " + common.output + " in " +
                 text_of_seconds(seconds) + '\n');
  return done;
}

}  // namespace

Command add_overlay_command(CLI::App& tool) {
  auto options = std::make_shared<OverlayOptions>();
  CLI::App* parser =
      tool.add_subcommand("overlay", "Compute unions, intersections and differences of features");
  add_input_file(*parser, "INPUT", options->common.input,
                 "The features A: .geojson, or sites: .csv .tsv .xyz .txt .npy, with GDAL\n"
                 "installed .gpkg .fgb .shp .parquet, the places of a netCDF file; or - for\n"
                 "standard input")
      ->type_name("");
  add_input_file(*parser, "SECOND", options->second,
                 "The features B; without them the union of A is written")
      ->required(false)
      ->type_name("");
  add_polygon_format_option(*parser, options->common);
  add_output_option(*parser, options->common,
                    "Where to write the features: .geojson; with GDAL installed .gpkg .fgb\n"
                    ".parquet")
      ->required();
  add_word<SetOperation>(
      *parser, "--how", options->how, named_values<SetOperation>(),
      "union (default), intersection, difference (A without B), symmetric-difference\n"
      "(what is in one of A and B) or identity (A, divided by B)");
  parser->add_flag("--dissolve", options->is_dissolved,
                   "Write one feature: the places of all pieces, without properties");
  parser->add_flag("--touching", options->has_touching,
                   "Write also the lines and points in which features only meet: where two lines\n"
                   "cross, where a line touches a polygon, and the borders between polygons");
  add_edges_option(*parser, options->read.edges, "the files");
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
      "without SECOND, as the union of INPUT is one feature");
  parser->footer(
      "Each feature of A is divided into its intersections with the features of B and what is\n"
      "in none of them, and the same for B; --how says which of these pieces are written. A\n"
      "piece has the properties of both features. Features are points, lines and polygons: a line\n"
      "is clipped by polygons, and divided where it crosses other lines of its file. Features of\n"
      "one file may overlap. Results are exact but for the rounding of places where sides cross,\n"
      "by less than 2 nanometers. Sites are points with the columns of their table.\n\n"
      "Examples:\n"
      "  rondel overlay countries.geojson -o land.geojson\n"
      "  rondel overlay countries.geojson basins.geojson --how intersection -o parts.geojson\n"
      "  rondel overlay countries.geojson lakes.geojson --how difference -o dry.geojson\n"
      "  rondel overlay rivers.geojson countries.geojson --how intersection -o by_country.geojson\n"
      "  rondel overlay stations.csv countries.geojson --how identity -o with_country.geojson");
  return {parser, [options] { return run_overlay(*options); }};
}

}  // namespace rondel::cli
