// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel remap: conservative weights from the cells of one file to those of another.
// in    two sides with cells: a grid, a mesh or grid of netCDF, polygons, or sites with Voronoi
//       cells
// out   a file of weights
// index source cells are columns, target cells are rows, in the order of their files
#include "rondel/remap.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cell_sides.h"
#include "job.h"
#include "process.h"
#include "report.h"
#include "rondel/cell_set.h"
#include "rondel/weight_files.h"

namespace rondel::cli {
namespace {

// The options of `rondel remap`.
struct RemapCommandOptions {
  CommonOptions common;   // INPUT: the source's cells; OUTPUT: the weights
  std::string target;     // TARGET; "-": standard input
  RemapOptions remap;     // --order --norm --overlap
  CellFileOptions cells;  // --sides --edges --invalid --corners
  NetcdfOptions netcdf;   // --kind --deflate

  // Return the two sides with their formats; --input-format is for the one on standard input.
  [[nodiscard]] FileName source_file() const { return common.source_beside(target); }
  [[nodiscard]] FileName target_file() const { return common.other_source(target); }
};

// Prints the numbers of cells and weights; `missing` counts target cells without any source.
void report(Job& job, const WeightFile& file, const std::string& output) {
  std::size_t empty = 0;
  const Weights& weights = file.weights;
  for (std::size_t r = 0; r < weights.num_rows(); ++r) {
    if (weights.offsets[r] == weights.offsets[r + 1]) ++empty;
  }
  const Seconds seconds = job.seconds();
  const nlohmann::ordered_json json = {{"sources", weights.num_columns},
                                       {"targets", weights.num_rows()},
                                       {"weights", weights.values.size()},
                                       {"missing", empty},
                                       {"seconds",
                                        {{"read", seconds.read},
                                         {"cells", seconds.dual},
                                         {"remap", seconds.query},
                                         {"write", seconds.write},
                                         {"total", seconds.total}}},
                                       {"peak_memory_bytes", peak_memory_bytes()}};
  job.report(json.dump(2) + '\n', count(weights.num_columns, "cell", "cells") + " to " +
                                      count(weights.num_rows(), "cell", "cells") + ", " +
                                      count(weights.values.size(), "weight", "weights") +
                                      "; targets without source: " + std::to_string(empty) +
                                      "\nwrote the weights to " + output + '\n');
}

// Reads the cells of both sides, computes the weights and writes them. Throws UsageError for a
// format in which no weights are written, FileError for files that cannot be read, and InvalidInput
// for cells of one side that overlap, unless --overlap has a rule for them.
ExitStatus run_remap(const RemapCommandOptions& options) {
  const CommonOptions& common = options.common;
  const std::string format = common.format();
  constexpr const char* formats[] = {"nc", "nc4", "npz", "esmf", "scrip"};
  require_output(common, std::ranges::find(formats, format) != std::end(formats), ".nc .nc4 .npz",
                 {{"TARGET", options.target}});
  Job job(common);
  CellSet source;
  CellSet target;
  const CellSideOptions read{options.cells, options.remap.overlap, common.read};
  job.time(Stage::dual, [&] {
    source = cells_of_side(options.source_file(), read, job);
    target = cells_of_side(options.target_file(), read, job);
  });
  WeightFile file;
  job.time(Stage::query, [&] {
    file = weight_file(rondel::remap(source, target, options.remap, job.execution()));
  });
  job.time(Stage::write, [&] { write_weights(common.target(), file, options.netcdf); });
  report(job, file, common.output);
  return done;
}

// Adds the options of grids and polygons, and of cells that are computed.
void add_kinds_of_sides(CLI::App& parser, RemapCommandOptions& options) {
  const CLI::Option* const sides = add_word<GridSides>(
      parser, "--sides", options.cells.sides, named_values<GridSides>(),
      "What cells of grids have in the north and south: parallels (default) or\n"
      "great-circles (ESMF's)");
  const CLI::Option* const edges = add_edges_option(parser, options.cells.edges, "polygons");
  const CLI::Option* const invalid =
      add_invalid_option(parser, options.cells.invalid, "cells and polygons");
  const CLI::Option* const corners = add_corners_option(parser, options.cells.corners);
  const auto has_side = [&options](CellForm form) {
    return form_of(options.source_file()) == form || form_of(options.target_file()) == form;
  };
  require_effect(
      options.common, sides,
      [has_side] { return has_side(CellForm::grid) || has_side(CellForm::netcdf); },
      "without a grid");
  require_effect(
      options.common, edges, [has_side] { return has_side(CellForm::polygons); },
      "without polygons");
  require_effect(
      options.common, invalid,
      [has_side] { return has_side(CellForm::netcdf) || has_side(CellForm::polygons); },
      "without cells in netCDF and polygons");
  require_effect(
      options.common, corners, [has_side] { return has_side(CellForm::netcdf); },
      "without cells in netCDF");
  add_build_options(parser, options.common);
  // Cells of the other forms are in the files; only those of sites are computed.
  for (const char* const name : {"--model", "--center"}) {
    require_effect(
        options.common, parser.get_option(name), [has_side] { return has_side(CellForm::sites); },
        "without sites, whose cells are computed");
  }
}

}  // namespace

Command add_remap_command(CLI::App& tool) {
  auto options = std::make_shared<RemapCommandOptions>();
  CLI::App* parser = tool.add_subcommand("remap", "Make conservative weights between cells");
  add_input_options(
      *parser, options->common,
      "The cells that have the values: netCDF with those of a model or a grid, the name\n"
      "of a grid (below), polygons in .geojson or with GDAL installed .gpkg .fgb .shp\n"
      ".parquet, or a file of sites, whose Voronoi cells they are: .csv .tsv .xyz .txt .npy,\n"
      "or - for standard input",
      [given = options.get()] {
        std::vector<FileName> sites = {given->source_file(), given->target_file()};
        std::erase_if(sites, [](const FileName& file) { return form_of(file) != CellForm::sites; });
        return sites;
      });
  add_input_file(*parser, "TARGET", options->target,
                 "The cells that get the values, in the same forms")
      ->type_name("");
  add_output_option(
      *parser, options->common,
      "Where to write the weights: .nc (ESMF; --format scrip for CDO), .nc4, .npz (SciPy)")
      ->required();
  add_netcdf_options(*parser, options->common, options->netcdf, [given = options.get()] {
    return if_of_format(given->common.target(), {"nc", "nc4", "esmf", "scrip"});
  });
  add_word<unsigned>(
      *parser, "--order", options->remap.order, {{"1", 1U}, {"2", 2U}},
      "1 (default): the field is constant in each source; 2: it has a gradient there");
  add_word<RemapNorm>(
      *parser, "--norm", options->remap.norm, named_values<RemapNorm>(),
      "What sums are divided by: destarea (default: the target's area, so integrals are\n"
      "kept) or fracarea (the part that sources cover, so constants are)");
  const CLI::Option* const overlap = add_word<CellOverlap>(
      *parser, "--overlap", options->remap.overlap, named_values<CellOverlap>(),
      "What becomes of a place that several cells of one side have: error (default: two of\n"
      "them are named), first (the cell with the lowest number has it), share (each has its\n"
      "part) or each (every target has all of its places)");
  require_effect(
      options->common, overlap,
      [given = options.get()] {
        const auto may_overlap = [](const FileName& side) {
          const CellForm form = form_of(side);
          return form == CellForm::netcdf || form == CellForm::polygons;
        };
        return may_overlap(given->source_file()) || may_overlap(given->target_file());
      },
      "on grids and cells of sites, which do not overlap");
  add_kinds_of_sides(*parser, *options);
  add_report_options(*parser, options->common);
  parser->footer(
      "netCDF may be UGRID, SCRIP, ESMF, MPAS, ICON, or a grid of CF; netCDF-4 is read by the\n"
      "library netCDF-C. Cells that the file masks take no part. Grids: grid:0.25,\n"
      "grid:1440x720, healpix:7, healpix:7:ring, F320, N320, O320, C384, R2B6,\n"
      "hexagons:R2B6, tripolar:0.25 (see rondel regrid).\n\n"
      "Examples:\n"
      "  rondel remap ocean.nc grid:1 -o weights.nc\n"
      "  rondel remap stations.csv countries.geojson --norm fracarea -o weights.npz\n"
      "  rondel remap grid:0.25 icon.nc --order 2 -o weights.nc --format scrip");
  return {parser, [options] { return run_remap(*options); }};
}

}  // namespace rondel::cli
