// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel graph makes graphs of near sites, hulls, alpha shapes and empty circles.
// in    sites that are not weighted
// out   GeoJSON: edges, polygons or circles; edges also as rows of two sites, circles as a table
// index sites in the order of the input
#include <CLI/CLI.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "job.h"
#include "report.h"
#include "rondel/graphs.h"
#include "rondel/names.h"
#include "rondel/outlines.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of the command; angles are in degrees.
struct GraphOptions {
  CommonOptions common;
  std::string kind;        // --kind
  double radius_deg = -1;  // --radius-deg; negative: not given
  std::size_t count = 1;   // --count
  bool anywhere = false;   // --anywhere
  double tolerance_deg = 0.01;
};

// Returns the words of --kind.
std::vector<std::string> kinds_of_graphs() {
  std::vector<std::string> kinds = {"hull", "alpha", "circles"};
  for (const std::string_view name : names_of<GraphKind>()) kinds.emplace_back(name);
  return kinds;
}

// Checks that OUTPUT can hold the result: graphs are rows of two sites, circles are rows of
// numbers, but polygons need GeoJSON.
void require_format(const GraphOptions& options) {
  const std::string format = options.common.format();
  const bool is_geojson = format == "geojson";
  if (from_name<GraphKind>(options.kind)) {
    require_output(options.common, is_geojson || format == "csv" || format == "npy",
                   ".geojson .csv .npy");
  } else if (options.kind == "circles") {
    require_output(options.common, is_geojson || format == "csv", ".geojson .csv");
  } else {
    require_output(options.common, is_geojson, ".geojson");
  }
}

// Checks, before any file is read, that the options fit the kind.
void require_options(const GraphOptions& options) {
  require_format(options);
  if (options.common.build.model == Model::weighted) {
    throw UsageError("--model: weighted sites have no graphs of distances");
  }
  if ((options.kind == "alpha") != (options.radius_deg >= 0)) {
    throw UsageError("--radius-deg belongs to --kind alpha, which needs it");
  }
}

// Circles that touch less than three sites are not found. If all sites are in one half of the
// sphere, the largest circle may be one of them.
void tell_of_other_circles(const GraphOptions& options, const SiteTable& table,
                           const Triangulation& triangulation, std::size_t num_found) {
  if (triangulation.num_vertices() == 0) return;
  const bool is_flat = triangulation.dimension() < 2;
  if (is_flat && !options.anywhere) {
    tell(table.name, {"all sites are on one great circle: no circle has its center in their hull"});
  } else if (options.anywhere && (is_flat ? num_found == 0 : triangulation.num_ghost_faces() > 0)) {
    tell(table.name, {"all sites are in one half of the sphere: a circle that touches "
                      "less than three of them may be larger, and is not looked for"});
  }
}

// Triangulates the sites, finds what --kind asks for and writes it. All kinds rest on the
// triangulation: the graphs are parts of it, and hull, alpha shape and circles are made of its
// faces. Throws UsageError, FileError.
ExitStatus run_graph(const GraphOptions& options) {
  require_options(options);
  Job job(options.common);
  const SiteTable table = job.read();
  const Triangulation triangulation = job.triangulate(table);
  const FileName target = options.common.target();
  // Each kind of result has a type of its own, but is found, written and reported in the same
  // stages.
  const auto run = [&](const auto& find, const auto& write, const std::string& what) {
    decltype(find()) found;
    job.time(Stage::dual, [&] { found = find(); });
    job.time(Stage::write, [&] { write(found); });
    job.report(triangulation, what);
  };
  const auto write_polygons = [&](const Outline& outline) {
    write_outline(target, triangulation, outline, options.tolerance_deg, job.execution());
  };
  if (const auto kind = from_name<GraphKind>(options.kind)) {
    run([&] { return site_graph(triangulation, *kind, job.execution()); },
        [&](const SiteGraph& graph) {
          write_graph(target, triangulation, graph, options.tolerance_deg, job.execution());
        },
        "the graph");
  } else if (options.kind == "hull") {
    run([&] { return hull_polygon(triangulation); }, write_polygons, "the hull");
  } else if (options.kind == "alpha") {
    // The library takes angles in radians.
    const double radius = options.radius_deg * std::numbers::pi / 180;
    run([&] { return alpha_shape(triangulation, radius, job.execution()); }, write_polygons,
        "the alpha shape");
  } else {
    const auto centers = options.anywhere ? CircleCenters::anywhere : CircleCenters::inside;
    run(
        [&] {
          return largest_empty_circles(triangulation, options.count, centers, job.execution());
        },
        [&](const auto& circles) {
          write_circles(target, circles);
          tell_of_other_circles(options, table, triangulation, circles.size());
        },
        "the circles");
  }
  return done;
}

}  // namespace

Command add_graph_command(CLI::App& tool) {
  const auto options = std::make_shared<GraphOptions>();
  CLI::App* parser = tool.add_subcommand(
      "graph", "Find graphs of near sites, hulls, alpha shapes or empty circles");
  add_input_options(*parser, options->common);
  add_output_option(*parser, options->common,
                    "Where to write them: .geojson; graphs also .csv .npy, circles also .csv")
      ->required();
  parser
      ->add_option("--kind", options->kind,
                   "delaunay, urquhart, gabriel, relative, mst, hull, alpha or circles")
      ->required()
      ->check(one_of(kinds_of_graphs()))
      ->type_name("WORD");
  parser
      ->add_option("--radius-deg", options->radius_deg,
                   "alpha: the largest radius of a triangle's circle, in degrees")
      ->check(positive_error)
      ->type_name("DEG");
  const CLI::Option* const count =
      parser
          ->add_option("--count", options->count,
                       "circles: how many of those of the faces, the largest first (default: 1)")
          ->check(positive_error)
          ->type_name("N");
  const CLI::Option* const anywhere =
      parser->add_flag("--anywhere", options->anywhere,
                       "circles: also those whose centers are outside of the sites' hull");
  const CLI::Option* const tolerance =
      parser
          ->add_option("--tolerance", options->tolerance_deg,
                       "How far a line may be from its great circle (default: 0.01)")
          ->check(positive_error)
          ->type_name("DEG");
  const auto are_circles = [given = options.get()] { return given->kind == "circles"; };
  require_effect(options->common, count, are_circles, "without --kind circles");
  require_effect(options->common, anywhere, are_circles, "without --kind circles");
  require_effect(
      options->common, tolerance,
      [given = options.get()] {
        return given->kind != "circles" && given->common.format() == "geojson";
      },
      "without lines in .geojson");
  add_build_options(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "Edges have the properties 'source', 'target' (sites from 0) and 'length_deg'; delaunay has "
      "those\n"
      "of the triangles that the center sees, the other graphs are parts of it: urquhart without "
      "the\n"
      "longest edge of each triangle, gabriel where no site is in the circle with diameter ab,\n"
      "relative where no site is nearer to both ends, mst the shortest tree.\n\n"
      "Examples:\n"
      "  rondel graph stations.csv --kind gabriel -o neighbors.geojson\n"
      "  rondel graph stations.csv --kind alpha --radius-deg 3 -o region.geojson\n"
      "  rondel graph stations.csv --kind circles --count 5 -o gaps.csv");
  return {parser, [options] { return run_graph(*options); }};
}

}  // namespace rondel::cli
