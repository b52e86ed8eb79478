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

#include "job.h"
#include "process.h"
#include "report.h"
#include "rondel/cell_set.h"
#include "rondel/delaunay.h"
#include "rondel/read_cells.h"
#include "rondel/weight_files.h"
#include "targets.h"

namespace rondel::cli {
namespace {

// The options of `rondel remap`.
struct RemapCommandOptions {
  CommonOptions common;   // INPUT: the source's cells; OUTPUT: the weights
  std::string target;     // TARGET; "-": standard input
  RemapOptions remap;     // --order --norm --overlap
  CellFileOptions cells;  // --sides --edges --invalid
  NetcdfOptions netcdf;   // --kind --deflate

  // Return the two sides with their formats; --input-format is for the one on standard input.
  [[nodiscard]] FileName source_file() const { return common.source_beside(target); }
  [[nodiscard]] FileName target_file() const { return common.other_source(target); }
};

// The forms of cells that `rondel remap` reads.
enum class CellForm { grid, netcdf, polygons, sites };

// Returns the form of INPUT or TARGET, by its name and, for netCDF, its first bytes.
CellForm form_of(const FileName& file) {
  if (NamedGrid::is_name(file.path)) return CellForm::grid;
  if (can_read_cells(file)) return CellForm::netcdf;
  const std::string format = format_of(file);
  return format == "geojson" || format == "json" ? CellForm::polygons : CellForm::sites;
}

// Returns the cells of a named grid. Throws UsageError for a grid that is not possible.
CellSet cells_of_grid(const std::string& name, const RemapCommandOptions& options, const Job& job) {
  try {
    return grid_of(name, options.cells.sides).cells(job.execution());
  } catch (const InvalidInput& error) {
    throw UsageError(name + ": " + error.what());
  }
}

// Returns the cells of netCDF or polygons, in the order of the file, and prints the remarks of the
// reader. Errors name features by their names, and cells by their numbers.
CellSet cells_of_file(const FileName& file, const RemapCommandOptions& options, const Job& job) {
  CellFileOptions read = options.cells;
  // Polygons that overlap are found when they are read, where the message can name both.
  if (options.remap.overlap == CellOverlap::error) read.overlap = PolygonOverlap::error;
  CellSet cells = CellSet::read(file, read, job.execution());
  if (cells.num_cells() == 0) throw FileError(cells.facts().name + ": there are no cells");
  tell(cells.facts().name, cells.facts().remarks);
  return cells;
}

// Sites are read as points and have the cells of their Voronoi diagram, or with weights power
// cells. The places of the cells are the sites, as given or as they are seen from the center.
// The index of the cells counts sites; one without a cell (hidden, duplicate) gets no weights.
CellSet cells_of_sites(const FileName& file, const RemapCommandOptions& options, Job& job) {
  ReadOptions read = options.common.read;
  read.keep_columns = false;
  const SiteTable table = job.read(file, read);
  const Triangulation triangulation = job.triangulate(table);
  const CellSet cells = CellSet::voronoi(triangulation, job.execution());
  CellFacts facts = cells.facts();
  facts.name = table.name;
  if (table.sites.empty()) throw FileError(table.name + ": " + no_points);
  const Point& center = triangulation.sphere().center;
  if (table.is_lonlat() && center == Point{}) {
    // Given longitudes and latitudes are kept to the digit.
    facts.centers = table.positions;
  } else {
    std::vector<Point> seen = table.sites;
    for (Point& site : seen) site = {site.x - center.x, site.y - center.y, site.z - center.z};
    facts.centers = lonlats(seen);
  }
  return cells.with_facts(std::move(facts));
}

// Reads the cells of a side in the form that its file has.
CellSet cells_of(const FileName& file, const RemapCommandOptions& options, Job& job) {
  const CellForm form = form_of(file);
  if (form == CellForm::grid) return cells_of_grid(file.path, options, job);
  return form == CellForm::sites ? cells_of_sites(file, options, job)
                                 : cells_of_file(file, options, job);
}

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
  job.time(Stage::dual, [&] {
    source = cells_of(options.source_file(), options, job);
    target = cells_of(options.target_file(), options, job);
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
  const CLI::Option* const edges = add_word<PolygonEdges>(
      parser, "--edges", options.cells.edges, named_values<PolygonEdges>(),
      "What joins positions of polygons: lonlat (default; straight in longitude and\n"
      "latitude, RFC 7946) or geodesic (great circles)");
  const CLI::Option* const invalid =
      add_invalid_option(parser, options.cells.invalid, "cells and polygons");
  const auto has_side = [&options](CellForm form) {
    return form_of(options.source_file()) == form || form_of(options.target_file()) == form;
  };
  require_effect(
      options.common, sides,
      [has_side] { return has_side(CellForm::grid) || has_side(CellForm::netcdf); },
      "without a grid");
  require_effect(
      options.common, edges, [has_side] { return has_side(CellForm::polygons); },
      "without polygons in .geojson");
  require_effect(
      options.common, invalid,
      [has_side] { return has_side(CellForm::netcdf) || has_side(CellForm::polygons); },
      "without cells in netCDF and polygons in .geojson");
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
      "of a grid (below), .geojson with polygons, or a file of sites, whose Voronoi cells\n"
      "they are: .csv .tsv .xyz .txt .npy, or - for standard input",
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
      "them are named), first (the cell with the lowest number has it) or share (each has its\n"
      "part)");
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
      "grid:1440x720, healpix:7, healpix:7:ring, F320, N320, O320, C384, R2B6 (see rondel\n"
      "regrid).\n\n"
      "Examples:\n"
      "  rondel remap ocean.nc grid:1 -o weights.nc\n"
      "  rondel remap stations.csv countries.geojson --norm fracarea -o weights.npz\n"
      "  rondel remap grid:0.25 icon.nc --order 2 -o weights.nc --format scrip");
  return {parser, [options] { return run_remap(*options); }};
}

}  // namespace rondel::cli
