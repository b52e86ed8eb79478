// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel voronoi: the Voronoi or power cells of sites. Options of 'rondel regions' make regions of
// them.
// in    sites; their columns become properties of GeoJSON
// out   a cell for each site that has one
// index sites in the order of the input
#include <CLI/CLI.hpp>
#include <memory>

#include "job.h"
#include "regions.h"
#include "rondel/diagram.h"
#include "rondel/regions.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// Adds --tolerance, the largest distance in degrees between a straight line in longitude and
// latitude and the great circle that it stands for.
void add_tolerance(CLI::App& parser, RegionsOptions& options) {
  const CLI::Option* const tolerance =
      parser
          .add_option("--tolerance", options.tolerance_deg,
                      "GeoJSON: how far a line may be from its great circle (default: 0.01)")
          ->check(positive_error)
          ->type_name("DEG");
  require_effect(
      options.common, tolerance,
      [&options] {
        const std::string format = options.common.format();
        return format != "vtp" && format != "npz";
      },
      "on .vtp and .npz, which have no polygons of straight lines");
}

// Writes whole cells through write_cells(). With an option of `rondel regions`, or in a format of
// GDAL, the cells are made by write_regions_of() instead. Hidden sites and duplicates have no cell.
// Throws UsageError for an OUTPUT in a format that has no cells.
ExitStatus run_voronoi(RegionsOptions options) {
  CommonOptions& common = options.common;
  require_output(common, can_write_cells(common.target()) || can_write_regions(common.target()),
                 ".geojson .vtp .npz .gpkg .fgb .parquet", {{"--clip", options.clip}});
  common.read.keep_columns = can_write_regions(common.target());  // these formats have properties
  if (makes_regions(options)) return write_regions_of(options);
  Job job(common);
  const SiteTable table = job.read();
  const Triangulation triangulation = job.triangulate(table);
  Diagram diagram;
  job.time(Stage::dual, [&] { diagram = rondel::diagram(triangulation, job.execution()); });
  job.time(Stage::write, [&] {
    write_cells(common.target(), table, triangulation, diagram, options.tolerance_deg,
                job.execution());
  });
  job.report(triangulation,
             common.build.model == Model::projected ? "the Voronoi cells" : "the power cells");
  return done;
}

}  // namespace

Command add_voronoi_command(CLI::App& tool) {
  auto options = std::make_shared<RegionsOptions>();
  CLI::App* parser = tool.add_subcommand("voronoi", "Compute the Voronoi or power cells of sites");
  add_input_options(*parser, options->common);
  add_output_option(
      *parser, options->common,
      "Where to write the cells: .geojson (a feature per cell, with its area and the\n"
      "input's columns), .vtp .npz; with GDAL installed .gpkg .fgb .parquet")
      ->required();
  add_tolerance(*parser, *options);
  add_region_options(*parser, *options);
  // The help shows these options in a group of their own, apart from those of whole cells.
  for (const char* const name :
       {"--clip", "--clip-value", "--edges", "--invalid", "--overlap", "--group", "--densify"}) {
    parser->get_option(name)->group("Clipped and joined cells, as 'rondel regions' makes them");
  }
  add_report_options(*parser, options->common);
  parser->footer(
      "Areas are in steradians; --earth-radius adds square kilometres. Hidden sites, which\n"
      "only circles and other weighted sites may be, have no cell.\n\n"
      "GeoPackage, FlatGeobuf and GeoParquet are written by GDAL (libgdal 3.0 or newer), which\n"
      "is looked for where the system has its libraries, or where RONDEL_GDAL says.\n\n"
      "Examples:\n"
      "  rondel voronoi stations.csv -o cells.geojson\n"
      "  rondel voronoi stations.csv --earth-radius 6371.0088 -o cells.gpkg\n"
      "  rondel voronoi circles.csv --radius radius -o power-cells.geojson");
  return {parser, [options] { return run_voronoi(*options); }};
}

}  // namespace rondel::cli
