// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel regrid: all fields of a file at the places or cells of another grid.
// in    netCDF with fields; a target: a named grid, netCDF with cells or places, polygons, or points
// out   the same fields at the target
// index places and cells in the order of their file or grid
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "extrapolate_options.h"
#include "job.h"
#include "process.h"
#include "report.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/named_grids.h"
#include "rondel/regrid_files.h"
#include "rondel/zonal_statistics.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel regrid`.
struct RegridCommandOptions {
  CommonOptions common;    // INPUT: the fields; output and threads
  std::string target;      // TARGET
  std::string source;      // --source
  std::string statistics;  // --statistics
  RegridFileOptions regrid;
  ExtrapolateOptions extrapolate;
};

// Regrids, and reports the numbers. Throws UsageError for a format in which no fields are written,
// FileError for files that cannot be read or do not fit the method.
ExitStatus run_regrid(const RegridCommandOptions& options) {
  const CommonOptions& common = options.common;
  require_output(common, can_write_fields(common.target()), ".nc .nc4 .csv .tsv .npy",
                 {{"TARGET", options.target}, {"--source", options.source}});
  Job job(common);
  RegridFileOptions regrid = options.regrid;
  if (!options.source.empty()) regrid.source = FileName{options.source, {}};
  if (!options.statistics.empty()) regrid.statistics = zonal_statistics_of(options.statistics);
  regrid.extrapolation = options.extrapolate.wanted();
  regrid.history = regrid_command(common.input, options.target, regrid);
  RegridFileReport done_work;
  job.time(Stage::query, [&] {
    done_work = regrid_file(common.source(), {options.target, {}}, common.target(), regrid,
                            job.execution());
  });
  tell(done_work.remarks);
  const nlohmann::ordered_json json = {{"sources", done_work.sources},
                                       {"targets", done_work.targets},
                                       {"fields", done_work.fields},
                                       {"missing", done_work.missing},
                                       {"extrapolated", done_work.extrapolated},
                                       {"tiles", done_work.tiles},
                                       {"resumed", done_work.resumed},
                                       {"seconds", {{"total", job.seconds().total}}},
                                       {"peak_memory_bytes", peak_memory_bytes()}};
  const std::string extrapolated =
      regrid.extrapolation ? "; extrapolated: " + std::to_string(done_work.extrapolated) +
                                 (done_work.resumed > 0 ? " by this run" : "")
                           : "";
  const std::string resumed =
      done_work.resumed == 0
          ? std::string()
          : "; " + count(done_work.resumed, "value", "values") + " of an earlier run";
  job.report(json.dump(2) + '\n', count(done_work.fields, "field", "fields") + " from " +
                                      count(done_work.sources, "place", "places") + " to " +
                                      std::to_string(done_work.targets) + extrapolated +
                                      "; values missing: " + std::to_string(done_work.missing) +
                                      resumed + '\n');
  return done;
}

// Adds how values are computed.
void add_methods(CLI::App& parser, RegridCommandOptions& options) {
  parser
      .add_option_function<std::string>(
          "--method",
          [&options](const std::string& text) {
            options.regrid.method = named_values<FieldMethod>().at(text);
          },
          "conservative (default): means over cells; conservative-2nd: with gradients;\n"
          "largest-share: the value with the largest share of the area (default for fields with\n"
          "flag_values or flag_meanings, of which conservative, if it is named, makes means);\n"
          "nearest, linear, laplace, sibson, hermite, cubic: between the centers; bilinear: on a\n"
          "grid along axes; native: in the cells of the mesh itself")
      ->check(one_of(keys_of(named_values<FieldMethod>())))
      ->type_name("WORD");
  const auto is_of_cells = [&options] {
    const auto& method = options.regrid.method;
    return !method || *method <= FieldMethod::largest_share;
  };
  const CLI::Option* const norm = add_word<RemapNorm>(
      parser, "--norm", options.regrid.norm, named_values<RemapNorm>(),
      "What sums are divided by: fracarea (default: the part that sources cover, so\n"
      "constants are kept) or destarea (the target's area, so integrals are)");
  parser
      .add_option("--max-missing", options.regrid.max_missing,
                  "The share of a target that no source may cover, and of its covered part in\n"
                  "which values may be missing, from 0 to 1 (default 0.5 for both)")
      ->check([](const std::string& text) { return range_error(text, 0, 1); })
      ->type_name("SHARE");
  const CLI::Option* const overlap = add_word<CellOverlap>(
      parser, "--overlap", options.regrid.overlap, named_values<CellOverlap>(),
      "Cells of one side that overlap: error (default), first, share, or each: every target has\n"
      "all of its places");
  const CLI::Option* const limiter = add_word<RemapLimiter>(
      parser, "--limiter", options.regrid.limiter, named_values<RemapLimiter>(),
      "conservative-2nd: none (default); bounds: no value is beyond those of its sources, and\n"
      "the integral over what has values is kept; or slopes: the gradient in a source leads to\n"
      "no value beyond those around it, and each source keeps its integral");
  require_effect(
      options.common, limiter,
      [&options] { return options.regrid.method == FieldMethod::conservative_2nd; },
      "without --method conservative-2nd");
  for (const CLI::Option* const option : {norm, overlap}) {
    require_effect(options.common, option, is_of_cells, "with a method between places");
  }
  require_effect(
      options.common, norm,
      [&options] { return options.regrid.method != FieldMethod::largest_share; },
      "with --method largest-share, which compares the parts of a target");
}

// Adds --vector, pairs of variables: "u10,v10".
void add_vectors(CLI::App& parser, RegridCommandOptions& options) {
  const CLI::Option* const vector =
      parser
          .add_option_function<std::vector<std::string>>(
              "--vector",
              [&options](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) {
                  options.regrid.vectors.push_back(*parts_at_comma(text));
                }
              },
              "Two variables that are eastward and northward components, as in u10,v10: they are\n"
              "carried as vectors in space, also near poles; may be repeated")
          ->check([](const std::string& text) {
            const auto parts = parts_at_comma(text);
            const bool is_pair = parts && !parts->first.empty() && !parts->second.empty();
            return is_pair ? std::string() : "'" + text + "' is not EAST,NORTH";
          })
          ->allow_extra_args(false)
          ->type_name("EAST,NORTH");
  require_effect(
      options.common, vector,
      [&options] { return options.regrid.method != FieldMethod::largest_share; },
      "with --method largest-share");
  require_effect(
      options.common, vector, [&options] { return options.statistics.empty(); },
      "with --statistics");
}

// Adds statistics in place of a method.
void add_statistics(CLI::App& parser, RegridCommandOptions& options) {
  parser
      .add_option(
          "--statistics", options.statistics,
          "Statistics of the values in each target instead of a method: a list such as\n"
          "mean,max,quantile:0.1 of mean, sum, count, min, max, fraction, variance, stdev,\n"
          "median, quantile:Q, majority, minority, variety")
      ->check([](const std::string& text) {
        try {
          zonal_statistics_of(text);
          return std::string();
        } catch (const InvalidInput& error) {
          return std::string(error.what());
        }
      })
      ->type_name("LIST");
  const CLI::Option* const weigh = add_word<ZonalWeights>(
      parser, "--weigh-by", options.regrid.statistic_weights, named_values<ZonalWeights>(),
      "The weight of a value: area (default: what its cell has in common with the target) or\n"
      "fraction (which share of the cell that is)");
  require_effect(
      options.common, weigh, [&options] { return !options.statistics.empty(); },
      "without --statistics");
  for (const char* const name : {"--method", "--norm", "--tile", "--resume", "--extrapolate"}) {
    require_effect(
        options.common, parser.get_option(name), [&options] { return options.statistics.empty(); },
        "with --statistics");
  }
}

void add_cells(CLI::App& parser, RegridCommandOptions& options) {
  CellFileOptions& cells = options.regrid.cells;
  const CLI::Option* const sides = add_word<GridSides>(
      parser, "--sides", cells.sides, named_values<GridSides>(),
      "What cells of grids have in the north and south: parallels (default) or\n"
      "great-circles (ESMF's)");
  const CLI::Option* const edges = add_edges_option(parser, cells.edges, "polygons");
  const CLI::Option* const invalid =
      add_invalid_option(parser, cells.invalid, "cells and polygons");
  const CLI::Option* const corners = add_corners_option(parser, cells.corners);
  const auto is_of_cells = [&options] {
    const auto& method = options.regrid.method;
    return !method || *method <= FieldMethod::largest_share;
  };
  const auto has_polygons = [&options] {
    return can_read_polygons(options.target) || can_read_polygons(options.source);
  };
  require_effect(options.common, edges, has_polygons, "without polygons");
  require_effect(options.common, edges, is_of_cells, "with a method between places");
  require_effect(
      options.common, invalid,
      [&options] {
        const bool is_source_named = !options.source.empty() && NamedGrid::is_name(options.source);
        return !is_source_named || !NamedGrid::is_name(options.target);
      },
      "between grids with names, whose cells are valid");
  for (const CLI::Option* const option : {sides, invalid, corners}) {
    require_effect(options.common, option, is_of_cells, "with a method between places");
  }
}

void add_amounts(CLI::App& parser, RegridCommandOptions& options) {
  parser
      .add_option_function<std::string>(
          "--memory",
          [&options](const std::string& text) { options.regrid.memory = bytes_of(text); },
          "About how many bytes may be in use, such as 500M (default 2G). Weights that need\n"
          "more are computed tile by tile, with the same values, or the error says how many\n"
          "bytes are enough")
      ->check(bytes_error)
      ->type_name("BYTES");
  const CLI::Option* const tile =
      parser
          .add_option("--tile", options.regrid.cells_per_tile,
                      "The number of cells of a tile (default: as --memory says)")
          ->check([](const std::string& text) { return whole_error(text, 1, 1'000'000'000); })
          ->type_name("N");
  require_effect(
      options.common, tile, [&options] { return options.regrid.limiter == RemapLimiter::none; },
      "with --limiter, which needs whole fields");
  parser.add_flag("--resume", options.regrid.resume,
                  "Keep what is computed in OUTPUT.partial until OUTPUT is complete, and begin\n"
                  "with what a run that ended early left there");
  add_netcdf_options(parser, options.common, options.regrid.netcdf, [&options] {
    return if_of_format(options.common.target(), {"nc", "nc4"});
  });
}

void add_regrid_files(CLI::App& parser, RegridCommandOptions& options) {
  parser
      .add_option("INPUT", options.common.input,
                  "netCDF with fields; FILE.nc:NAME is one of them, or one of several grids")
      ->required()
      ->type_name("");
  parser
      .add_option(
          "TARGET", options.target,
          "The name of a grid (below), netCDF with cells or places, polygons: .geojson, and with\n"
          "GDAL installed .gpkg .fgb .shp .parquet; or points, for methods between places: these\n"
          "formats, .csv .tsv .xyz .txt .npy")
      ->required()
      ->type_name("");
  add_output_option(parser, options.common, "Where to write the fields: .nc .nc4 .csv .tsv .npy")
      ->required();
  parser
      .add_option("--value", options.regrid.names,
                  "A variable (default: all at the places of the source); may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME");
  parser
      .add_option("--source", options.source,
                  "Where the fields are, if INPUT does not say it: the name of a grid, or a file\n"
                  "with cells")
      ->type_name("GRID");
}

}  // namespace

Command add_regrid_command(CLI::App& tool) {
  auto options = std::make_shared<RegridCommandOptions>();
  CLI::App* parser = tool.add_subcommand("regrid", "Bring the fields of a file to another grid");
  add_regrid_files(*parser, *options);
  add_methods(*parser, *options);
  add_vectors(*parser, *options);
  add_extrapolate_options(*parser, options->common, options->extrapolate);
  add_cells(*parser, *options);
  add_amounts(*parser, *options);
  add_statistics(*parser, *options);
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "Grids: grid:0.25 and grid:1440x720 (between meridians and parallels), healpix:7 and\n"
      "healpix:7:ring (12 * 4^7 pixels), F320, N320, O320 (Gaussian: regular, reduced,\n"
      "octahedral), C384 (cubed sphere), R2B6 (triangles of an icosahedron), hexagons:R2B6 "
      "(around\n"
      "their corners), tripolar:0.25 (an ocean with two poles on land).\n\n"
      "Values that are sums over cells by their cell_methods, such as people per cell (area: "
      "sum),\n"
      "stay sums with the conservative methods: each target gets its share of each source.\n\n"
      "All times and levels are carried, with attributes, axes, and variables without places. A\n"
      "target is missing if sources cover less than half of it, or less than half of what they\n"
      "cover has values (--max-missing).\n\n"
      "At points, other columns and properties, and what netCDF says of its places (names of\n"
      "stations), stand beside the values; netCDF has them along the dimension point, with CF's\n"
      "featureType.\n\n"
      "Examples:\n"
      "  rondel regrid temperature.nc healpix:4 -o pixels.nc\n"
      "  rondel regrid temperature.nc grid:1 --method linear -o one-degree.nc\n"
      "  rondel regrid temperature.nc countries.geojson --overlap each -o means.csv\n"
      "  rondel regrid temperature.nc countries.geojson --overlap each --statistics mean,max \\\n"
      "      -o extremes.csv\n"
      "  rondel regrid temperature.nc stations.csv --method linear -o at-stations.nc\n"
      "  rondel regrid ocean.nc grid:1 --extrapolate creep --extrapolate-levels 3 -o filled.nc\n"
      "  rondel regrid winds.nc healpix:6 --vector u10,v10 -o winds-on-pixels.nc\n"
      "  rondel regrid wrf.nc grid:0.1 --corners made -o means.nc");
  return {parser, [options] { return run_regrid(*options); }};
}

}  // namespace rondel::cli
