// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The arguments and the help of the commands of `rondel mesh` that make meshes.

#include <CLI/CLI.hpp>
#include <memory>
#include <vector>

#include "mesh_make.h"
#include "validate.h"
#include "words.h"

namespace rondel::cli {
namespace {

// Checks a number of sites, or another whole number of at least 1.
std::string sites_error(const std::string& text) { return whole_error(text, 1, max_sites); }

// Adds the options about results that all commands of this file share.
void add_mesh_output(CLI::App& parser, MeshOutput& output) {
  add_mesh_output_options(parser, output, MeshOutputKind::mesh_or_sites);
  add_threads_option(parser, output.common);
  add_report_options(parser, output.common);
}

// Adds the conditions under which the relaxation of a centroidal mesh ends.
void add_tolerances(CLI::App& parser, mesh::ScvtOptions& options) {
  parser
      .add_option("--tolerance", options.mean_tolerance,
                  "Mean distance of sites from the centroids of their cells,\n"
                  "over the spacing (default: 1e-4)")
      ->check(positive_error)
      ->type_name("T");
  parser
      .add_option("--max-tolerance", options.largest_tolerance,
                  "The largest of these distances (default: 1e-2)")
      ->check(positive_error)
      ->type_name("T");
  parser.add_option("--max-steps", options.max_iterations, "Steps in each level (default: 1000)")
      ->check([](const std::string& text) { return whole_error(text, 0, 1'000'000'000); })
      ->type_name("N");
}

// Adds the files of places that become sites which are never moved.
void add_places_that_stay(CLI::App& parser, ScvtCommandOptions& options) {
  parser
      .add_option("--fixed", options.fixed,
                  "Points of FILE, .geojson or a table, are sites of the mesh and never move;\n"
                  "so are places on lines and outlines of FILE, the spacing apart;\n"
                  "may be repeated")
      ->allow_extra_args(false)
      ->type_name("FILE");
  parser
      .add_option("--along", options.along,
                  "Let edges of cells follow the lines or outlines of FILE, .geojson: rows of\n"
                  "sites on both sides never move; may be repeated")
      ->allow_extra_args(false)
      ->type_name("FILE");
  const CLI::Option* const edges = add_word<PolygonEdges>(
      parser, "--edges", options.edges, named_values<PolygonEdges>(),
      "What joins positions of --refine, --fixed and --along: lonlat (default;\n"
      "straight in longitude and latitude, RFC 7946) or geodesic (great circles)");
  require_effect(
      options.output.common, edges,
      [&options] {
        return !(options.refine.empty() && options.fixed.empty() && options.along.empty());
      },
      "without --refine, --fixed or --along");
}

// Adds the bound on how fast the spacing grows: by G kilometers a kilometer.
void add_gradient(CLI::App& parser, ScvtCommandOptions& options) {
  const CLI::Option* const gradient =
      parser
          .add_option("--gradient", options.slope,
                      "How much the spacing grows over its own distance, at most\n"
                      "(default: 0.05 of --refine; files as they are)")
          ->check(positive_error)
          ->type_name("G");
  require_effect(
      options.output.common, gradient,
      [&options] { return !options.refine.empty() || is_file_of_spacings(options.spacing); },
      "without --refine or a file of --spacing");
}

Command add_scvt_command(CLI::App& group) {
  auto options = std::make_shared<ScvtCommandOptions>();
  CLI::App* parser = group.add_subcommand("scvt", "Make a centroidal Voronoi mesh");
  CLI::Option* number =
      parser->add_option("-n,--number", options->scvt.count, "Number of cells, also as 1e6");
  number->check([](const std::string& text) { return whole_error(text, 12, max_sites); })
      ->transform(digits_of_whole)
      ->type_name("N");
  CLI::Option* spacing = parser->add_option(
      "--spacing", options->spacing,
      "Distance of neighbors: kilometers, or a file of them, FILE.nc[:NAME]\n"
      "or FILE.csv:COLUMN; with -n only its proportions count. The attribute units\n"
      "of netCDF may say meters (m)");
  spacing->type_name("KM|FILE");
  parser
      ->add_option("--refine", options->refine,
                   "Kilometers near the lines, outlines or points of FILE, .geojson\n"
                   "or a table; may be repeated")
      ->allow_extra_args(false)
      ->needs(spacing)
      ->type_name("FILE:KM");
  add_gradient(*parser, *options);
  parser
      ->add_option("--density", options->density,
                   "Spacing as the power -1/4 of this density of a tessellation, FILE.nc:NAME or\n"
                   "FILE.csv:COLUMN; of a mesh of MPAS FILE.nc:meshDensity")
      ->needs(number)
      ->excludes(spacing)
      ->type_name("FILE");
  add_places_that_stay(*parser, *options);
  CLI::Option* start = parser->add_option("--start", options->start,
                                          "Begin with the sites of FILE, and keep them in order");
  start->excludes(number)->type_name("FILE");
  add_word<mesh::ScvtMethod>(*parser, "--method", options->scvt.method,
                             named_values<mesh::ScvtMethod>(),
                             "lbfgs (default), or lloyd, to compare");
  add_tolerances(*parser, options->scvt);
  parser->add_flag("--no-repair", options->no_repair,
                   "Leave short edges, obtuse triangles, and cells with\n"
                   "other than 5 to 7 sides");
  add_mesh_output(*parser, options->output);
  parser->footer(
      "Kilometers are those of a sphere of 6371.229 km. With Ctrl-C the mesh so far is written, "
      "and\n"
      "the exit status is 1. Sides along which a file has cut polygons at longitude 180, or has\n"
      "led them around a pole, are no lines.\n\n"
      "Examples:\n"
      "  rondel mesh scvt -n 40962 -o x1.40962.nc\n"
      "  rondel mesh scvt --spacing 240 --refine coast.geojson:60 -o coast.nc --report coast.json\n"
      "  rondel mesh scvt -n 40962 --along land.geojson -o coast.nc\n"
      "  rondel mesh scvt --spacing 240 --fixed sections.geojson -o sections.nc\n"
      "  rondel mesh scvt --spacing spacing.nc:h -o mesh.nc --format ugrid");
  return {parser, [options] { return run_scvt(*options); }};
}

Command add_icosahedral_command(CLI::App& group) {
  auto options = std::make_shared<IcosahedralCommandOptions>();
  CLI::App* parser =
      group.add_subcommand("icosahedral", "Make a mesh of a divided icosahedron, relaxed");
  parser->add_option("LEVELS", options->levels, "Divisions in four: 10 * 4^LEVELS + 2 cells")
      ->required()
      ->check([](const std::string& text) { return whole_error(text, 0, 12); })
      ->type_name("");
  parser->add_flag("--no-relax", options->keep, "Leave the sites in the middles of edges");
  add_mesh_output(*parser, options->output);
  parser->footer("Example:\n  rondel mesh icosahedral 6 -o x1.40962.nc");
  return {parser, [options] { return run_icosahedral(*options); }};
}

Command add_points_command(CLI::App& group) {
  auto options = std::make_shared<MeshPointsOptions>();
  CLI::App* parser = group.add_subcommand("points", "Make the mesh of sites of a known kind");
  parser->add_option("KIND", options->kind, "healpix, reduced-gaussian, cubed-sphere or poisson")
      ->required()
      ->check(
          CLI::IsMember({"healpix", "reduced-gaussian", "cubed-sphere", "poisson"}).description(""))
      ->type_name("");
  parser
      ->add_option("--size", options->size,
                   "HEALPix's side, the N of O(N), cells along an edge of the cube")
      ->check(sites_error)
      ->type_name("N");
  parser->add_option("--radius", options->radius_km, "poisson: the least distance")
      ->check(positive_error)
      ->type_name("KM");
  CLI::Option* const seed = parser->add_option("--seed", options->seed,
                                               "poisson: seed of the random numbers (default: 1)");
  seed->check(seed_error)->type_name("S");
  require_effect(
      options->output.common, seed, [given = options.get()] { return given->kind == "poisson"; },
      "on sites that are not random");
  add_mesh_output(*parser, options->output);
  parser->footer(
      "Examples:\n"
      "  rondel mesh points healpix --size 64 -o centers.npy\n"
      "  rondel mesh points poisson --radius 100 -o poisson.nc --format ugrid");
  return {parser, [options] { return run_mesh_points(*options); }};
}

Command add_area_partition_command(CLI::App& group) {
  auto options = std::make_shared<AreaPartitionCommandOptions>();
  CLI::App* parser =
      group.add_subcommand("partition", "Give the cells of sites prescribed areas, by weights");
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
      "  rondel mesh partition stations.csv -o equal.npy\n"
      "  rondel voronoi equal.npy --model weighted -o equal.geojson");
  return {parser, [options] { return run_area_partition(*options); }};
}

}  // namespace

std::vector<Command> add_mesh_making_commands(CLI::App& mesh) {
  return {add_scvt_command(mesh), add_icosahedral_command(mesh), add_points_command(mesh),
          add_area_partition_command(mesh)};
}

}  // namespace rondel::cli
