// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The arguments and the help of every command (plot apart: plot.cpp).

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "command.h"
#include "inputs/kinds.h"
#include "point_set_kinds.h"
#include "run.h"
#include "validate.h"
#include "words.h"

namespace rondel::cli {
namespace {

// Checks a radius, whose areas must not overflow.
std::string earth_radius_error(const std::string& text) {
  std::string error = positive_error(text);
  if (!error.empty()) return error;
  double radius = 0;
  std::from_chars(text.data(), text.data() + text.size(), radius);
  if (std::isnormal(4 * std::numbers::pi * (radius * radius))) return {};
  return "'" + text + "' is the radius of a sphere whose area is no number";
}

// Returns what is wrong with the name of a kind of sites; empty if there is such a kind.
std::string kind_error(const std::string& text) {
  return find_kind(text) != nullptr ? std::string() : "'" + text + "' is not a kind";
}

// Checks a number of sites: at least 1, at most as many as an index can count.
std::string count_error(const std::string& text) { return whole_error(text, 1, max_sites); }

// Returns the table of kinds for the help of `rondel generate`, a line for each kind.
std::string kinds_help() {
  const auto list = [](std::span<const inputs::Kind> kinds) {
    std::string text;
    for (const inputs::Kind& kind : kinds) {
      std::string name(kind.name);
      name.resize(18, ' ');
      text += "  " + name + std::string(kind.what) + '\n';
    }
    return text;
  };
  return "Kinds:\n" + list(inputs::plain_kinds()) + "\nSets of known numbers of sites:\n" +
         list(point_set_kinds()) +
         "\nHostile kinds, which cost some algorithms much time or many digits:\n" +
         list(inputs::hostile_kinds());
}

// Checks a distance on the sphere in degrees.
std::string distance_error(const std::string& text) { return range_error(text, 0, 180); }

// Adds what locate and nearest share: INPUT, QUERIES and where the answers go, by default standard
// output. `formats` says for the help in which formats answers are written.
void add_query_options(CLI::App& parser, QueryOptions& options, const std::string& formats) {
  options.common.output = "-";
  add_input_options(parser, options.common, default_input_help, [&options] {
    return std::vector<FileName>{options.common.source(), {options.queries, options.query_format}};
  });
  parser
      .add_option("QUERIES", options.queries,
                  "The points to ask for, in the formats of INPUT; columns that are named\n"
                  "by an option have the same name in both. One of the two may be -")
      ->required()
      ->type_name("");
  add_output_option(parser, options.common, "Where to write the answers: " + formats);
  add_build_options(parser, options.common);
  add_report_options(parser, options.common);
}

// Adds the files that `rondel delaunay` writes beside the triangles. An array is indexed by site or
// by face, and each is written only if its option is given.
void add_arrays(CLI::App& command, DelaunayOptions& options) {
  command
      .add_option("--neighbors", options.neighbors,
                  "Where to write the neighbors: .npy, m x 3, the face opposite to each corner")
      ->type_name("FILE");
  command
      .add_option("--areas", options.areas,
                  "Where to write the areas of the cells: .npy, n numbers in steradians")
      ->type_name("FILE");
  command
      .add_option("--circumcenters", options.circumcenters,
                  "Where to write the circumcenters of the triangles (--model weighted: the power\n"
                  "centers): .npy, m x 3, unit vectors from the center of the sphere")
      ->type_name("FILE");
  command
      .add_option("--duplicates", options.duplicates,
                  "Where to write the duplicates: .npy, k x 2, the site and the one it repeats")
      ->type_name("FILE");
}

// Adds the options for sites that do not fit into memory. They go to another program path
// (out_of_core.cpp), which has no circumcenters.
void add_out_of_core(CLI::App& command, DelaunayOptions& options) {
  const char* const group = "More sites than fit into memory: .npy to .npy";
  CLI::Option* scratch =
      command
          .add_option("--scratch", options.scratch,
                      "A directory for files of some 64 bytes a site, 88 with neighbors,\n"
                      "128 with areas; made if it is not there, and removed at the end")
          ->type_name("DIR")
          ->check(
              [](const std::string& name) { return std::string(name.empty() ? "no name" : ""); })
          ->excludes(command.get_option("--circumcenters"))
          ->group(group);
  command
      .add_option_function<std::string>(
          "--memory", [&options](const std::string& text) { options.memory = bytes_of(text); },
          "What may be in memory at once: bytes, or 500M, 1.5g (K, M, G, T; default: 2G)")
      ->check(bytes_error)
      ->needs(scratch)
      ->type_name("SIZE")
      ->group(group);
  command
      .add_flag("--resume", options.resume,
                "Go on with what a run that ended early left in the scratch directory")
      ->needs(scratch)
      ->group(group);
}

}  // namespace

Command add_delaunay_command(CLI::App& tool) {
  auto options = std::make_shared<DelaunayOptions>();
  CLI::App* parser = tool.add_subcommand("delaunay", "Triangulate sites on or near a sphere");
  add_input_options(*parser, options->common);
  add_output_option(*parser, options->common,
                    "Where to write the triangles: .npy (m x 3 input indices), .off .ply .obj\n"
                    ".stl .vtp .geojson")
      ->required();
  add_build_options(*parser, options->common);
  add_arrays(*parser, *options);
  add_out_of_core(*parser, *options);
  add_report_options(*parser, options->common);
  parser->footer(
      "The triangulation is exact and unique: it depends on the set of sites alone.\n\n"
      "Examples:\n"
      "  rondel delaunay stations.csv -o stations.geojson\n"
      "  rondel delaunay points.xyz --model weighted -o hull.ply\n"
      "  rondel delaunay stations.csv --lon east --lat north --json -o faces.npy\n"
      "  rondel delaunay sites.npy -o faces.npy --memory 2G --scratch scratch");
  return {parser, [options] { return run_delaunay(*options); }};
}

// Adds the options that say what polygons of files mean: the lines between their positions, and
// places that several of them have.
void add_polygon_words(CLI::App& parser, VoronoiOptions& options) {
  add_word<PolygonEdges>(
      parser, "--edges", options.edges, named_values<PolygonEdges>(),
      "What joins positions of --clip and --densify: lonlat (default; straight in\n"
      "longitude and latitude, RFC 7946) or geodesic (great circles)");
  add_word<PolygonOverlap>(
      parser, "--overlap", options.overlap,
      {{"error", PolygonOverlap::error}, {"first", PolygonOverlap::first}},
      "What becomes of a place that several polygons of --clip-value or --densify have:\n"
      "error (default: two of them are named) or first (it is of the first one)");
}

// Adds --tolerance, the largest distance in degrees between a straight line in longitude and
// latitude and the great circle that it stands for.
void add_tolerance(CLI::App& parser, VoronoiOptions& options) {
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

// Tells of options for polygons without them, and of those for sites with lines and polygons.
void require_effects(const CLI::App& parser, VoronoiOptions& options) {
  const auto has_features = [&options] { return options.densify_km > 0; };
  require_effect(
      options.common, parser.get_option("--edges"),
      [=, &options] { return has_features() || !options.clip.empty(); },
      "without --clip or --densify");
  require_effect(
      options.common, parser.get_option("--overlap"),
      [=, &options] { return has_features() || !options.clip_value.empty(); },
      "without --clip-value or --densify");
  for (const char* const name :
       {"--radius", "--radians", "--delimiter", "--lon", "--x", "--model", "--center"}) {
    require_effect(
        options.common, parser.get_option(name), [=] { return !has_features(); },
        "with --densify, whose INPUT has lines and polygons");
  }
}

Command add_voronoi_command(CLI::App& tool) {
  auto options = std::make_shared<VoronoiOptions>();
  CLI::App* parser = tool.add_subcommand("voronoi", "Compute the Voronoi or power cells of sites");
  add_input_options(*parser, options->common);
  add_output_option(
      *parser, options->common,
      "Where to write the cells: .geojson (a feature per cell, with its area and the\n"
      "input's columns), .vtp .npz; with GDAL installed .gpkg .fgb .parquet")
      ->required();
  add_tolerance(*parser, *options);
  parser
      ->add_option(
          "--clip", options->clip,
          "Keep what lies in the polygons of this file (.geojson), as of land or countries")
      ->type_name("FILE");
  parser
      ->add_option("--clip-value", options->clip_value,
                   "Cut cells where this property of --clip's polygons changes, and keep it: a\n"
                   "feature for each cell and text; polygons without a text are left out")
      ->type_name("COL");
  add_polygon_words(*parser, *options);
  parser
      ->add_option("--group", options->group,
                   "Join the cells of all sites with the same text in this column; sites without\n"
                   "a text are left out")
      ->type_name("COL");
  parser
      ->add_option("--densify", options->densify_km,
                   "INPUT has lines and polygons (.geojson): a cell for each feature, of the\n"
                   "places from which no other is nearer by more than KM")
      ->check(positive_error)
      ->type_name("KM");
  parser
      ->add_option("--earth-radius", options->earth_radius_km,
                   "Adds areas on a sphere of this radius, 'area_km2' (the Earth's mean radius\n"
                   "is 6371.0088, which --densify supposes)")
      ->check(earth_radius_error)
      ->type_name("KM");
  add_build_options(*parser, options->common);
  require_effects(*parser, *options);
  add_report_options(*parser, options->common);
  parser->footer(
      "Areas are in steradians; --earth-radius adds square kilometres. Hidden sites, which\n"
      "only circles and other weighted sites may be, have no cell.\n\n"
      "GeoPackage, FlatGeobuf and GeoParquet are written by GDAL (libgdal 3.0 or newer), which\n"
      "is looked for where the system has its libraries, or where RONDEL_GDAL says.\n\n"
      "Examples:\n"
      "  rondel voronoi stations.csv -o cells.geojson\n"
      "  rondel voronoi stations.csv --clip land.geojson --group country -o groups.geojson\n"
      "  rondel voronoi stations.csv --clip countries.geojson --clip-value name -o parts.gpkg\n"
      "  rondel voronoi rivers.geojson --densify 0.5 --earth-radius 6371.0088 -o basins.geojson\n"
      "  rondel voronoi circles.csv --radius radius -o power-cells.geojson");
  return {parser, [options] { return run_voronoi(*options); }};
}

Command add_hull_command(CLI::App& tool) {
  auto options = std::make_shared<HullCommandOptions>();
  CLI::App* parser = tool.add_subcommand("hull", "Compute the convex hull of points in space");
  add_point_input_options(*parser, options->common);
  add_output_option(*parser, options->common,
                    "Where to write the triangles: .npy (m x 3 input indices), .off .ply .obj\n"
                    ".stl .vtp")
      ->required();
  parser->add_flag("--compact", options->is_compact,
                   "Write the vertices of the hull only, renumbered; otherwise every input point\n"
                   "is written, in input order");
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "The hull is exact and unique; its vertices are the extreme points alone. Points in one\n"
      "plane make a flat hull, which is written as a surface with two sides; points on one\n"
      "line make no triangles. Volume and area are sums in doubles.\n\n"
      "Examples:\n"
      "  rondel hull scan.xyz -o hull.ply --compact\n"
      "  rondel hull points.npy --json -o faces.npy");
  return {parser, [options] { return run_hull(*options); }};
}

Command add_check_command(CLI::App& tool) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* parser =
      tool.add_subcommand("check", "Prove or refute that triangles are the triangulation of sites");
  add_input_options(*parser, options->common);
  parser
      ->add_option("TRIANGLES", options->triangles,
                   "The triangles, as input indices: .npy .off .ply .obj .vtp")
      ->required()
      ->type_name("");
  add_build_options(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "Checks that the triangles form one closed surface, that every site is accounted for\n"
      "and that every edge is Delaunay, by exact arithmetic. Exit status: 0 if it is proved,\n"
      "1 if it is refuted or a file cannot be read.\n\n"
      "Example:\n"
      "  rondel check stations.csv faces.npy");
  return {parser, [options] { return run_check(*options); }};
}

Command add_generate_command(CLI::App& tool) {
  auto options = std::make_shared<GenerateOptions>();
  CLI::App* parser = tool.add_subcommand("generate", "Generate sites to try things out");
  inputs::Recipe& recipe = options->recipe;
  parser->add_option("KIND", options->kind, "What to generate: see below")
      ->required()
      ->check(kind_error)
      ->type_name("");
  CLI::Option* number = parser->add_option("-n,--number", recipe.n, "Number of sites, also as 1e6");
  number->check(count_error)->transform(digits_of_whole)->type_name("N");
  add_output_option(*parser, options->common,
                    "Where to write the sites: .csv .tsv (with a header), .xyz .txt .npy")
      ->required();
  CLI::Option* seed =
      parser->add_option("--seed", recipe.seed, "Seed of the random numbers (default: 1)");
  seed->check(seed_error)->type_name("S");
  require_effect(
      options->common, seed, [given = options.get()] { return find_kind(given->kind)->is_random; },
      "on sites that are not random");
  CLI::Option* angle = parser->add_option("--angle", options->angle,
                                          "Angular radius of patch, cluster, cap and\n"
                                          "small-circle, largest one of circles, width of wedge,\n"
                                          "least distance of poisson");
  angle->check(positive_error)->type_name("DEG");
  parser->add_flag("--radians", options->common.read.radians, "--angle is in radians")
      ->needs(angle);
  CLI::Option* rows = parser->add_option("--rows", recipe.rows, "lonlat-grid: number of parallels");
  CLI::Option* columns =
      parser->add_option("--columns", recipe.columns, "lonlat-grid: number of meridians");
  for (CLI::Option* option : {rows, columns}) {
    option->check(count_error)->transform(digits_of_whole)->type_name("N");
  }
  rows->needs(columns)->excludes(number);
  columns->needs(rows);
  add_report_options(*parser, options->common);
  parser->footer(kinds_help() +
                 "\nThe same seed gives the same bytes on every machine.\n\n"
                 "Examples:\n"
                 "  rondel generate uniform -n 100000 -o sites.npy\n"
                 "  rondel generate circles -n 1000 --angle 20 -o circles.csv\n"
                 "  rondel generate patch -n 1000 --angle 0.01 --seed 7 -o patch.csv");
  return {parser, [options] { return run_generate(*options); }};
}

Command add_info_command(CLI::App& tool) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App* parser = tool.add_subcommand("info", "Say what a file of sites holds");
  add_input_options(*parser, *options);
  add_build_options(*parser, *options);
  add_report_options(*parser, *options);
  parser->footer(
      "Prints the number of sites, their bounds, exact duplicates, the distance from\n"
      "the sphere, and the columns.\n\n"
      "Example:\n"
      "  rondel info stations.csv");
  return {parser, [options] { return run_info(*options); }};
}

Command add_locate_command(CLI::App& tool) {
  auto options = std::make_shared<QueryOptions>();
  CLI::App* parser = tool.add_subcommand("locate", "Tell in which triangle points lie");
  add_query_options(*parser, *options, ".csv .tsv (standard output: CSV), or .npy: the\nfaces");
  parser->footer(
      "A row for each query: whether its ray from the center meets a vertex, an edge, a face,\n"
      "or the outside (no face that the center sees), the face, and the 1, 2 or 3 sites. Faces\n"
      "are numbered as 'rondel delaunay' writes them; .npy holds their numbers (4294967295\n"
      "outside).\n\n"
      "Example:\n"
      "  rondel locate stations.csv ships.csv -o faces.csv");
  return {parser, [options] { return run_locate(*options); }};
}

Command add_nearest_command(CLI::App& tool) {
  auto options = std::make_shared<QueryOptions>();
  CLI::App* parser = tool.add_subcommand("nearest", "Find the sites nearest to points");
  add_query_options(*parser, *options, ".csv .tsv (standard output: CSV), or .npy: the\nsites");
  CLI::Option* k = parser->add_option("-k,--count", options->k, "The K nearest sites (default: 1)");
  k->check(count_error)->type_name("K");
  parser
      ->add_option("--within", options->within_deg,
                   "All sites at a distance of at most DEG, from 0 to 180")
      ->excludes(k)
      ->check(distance_error)
      ->type_name("DEG");
  parser
      ->add_option("--column", options->columns,
                   "Add this column of INPUT to the answers; may be repeated. A column 'site' is\n"
                   "called 'site_' there, as the answers have one of that name")
      ->allow_extra_args(false)
      ->type_name("COL");
  parser->footer(
      "A row for each site found: the query, the site (both counted from 0) and its distance,\n"
      "the nearest first, ties by site; with --within in the order of the sites. The distance\n"
      "is the angle; with --model weighted it is the Laguerre distance, which is 0 within a\n"
      "circle. Comparisons are exact. .npy holds the sites as (queries) or (queries x K),\n"
      "4294967295 for none.\n\n"
      "Examples:\n"
      "  rondel nearest stations.csv ships.csv --column name\n"
      "  rondel nearest stations.csv ships.csv --within 2 -o close.csv");
  return {parser, [options] { return run_nearest(*options); }};
}

}  // namespace rondel::cli
