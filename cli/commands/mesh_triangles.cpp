// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel mesh triangles: fills what coasts leave, or an area, with triangles.
// in    polygons of land and of an area, lines, spacings, depths
// out   a mesh of triangles for ocean models
// index nodes and triangles from 0; in files as the format has them
#include "rondel/mesh_triangles.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command.h"
#include "files_of_command.h"
#include "job.h"
#include "mesh_output.h"
#include "mesh_spacing.h"
#include "options.h"
#include "report.h"
#include "rondel/error.h"
#include "rondel/geometries.h"
#include "rondel/mesh_size_files.h"
#include "rondel/triangle_files.h"
#include "triangle_output.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of the command.
struct MeshTrianglesOptions {
  CommonOptions common;
  std::vector<std::string> coast;
  std::vector<std::string> area;
  std::vector<std::string> lines;
  ScvtFiles sizes;  // --spacing --refine --gradient, and how polygons are read
  double angle = mesh::RefineOptions{}.smallest_angle_deg;
  std::optional<double> tolerance_km;
  std::optional<double> weld_km;
  double fill_narrow = 0;
  double smallest_part = 0;
  std::string depth;      // --depth: positive down
  std::string elevation;  // --elevation: positive up
  std::optional<double> least_depth;
  std::string report;  // --report; empty: not written
  NetcdfOptions netcdf;
};

std::vector<NamedFile> files_read(const MeshTrianglesOptions& options) {
  std::vector<NamedFile> files = files_read(options.sizes);
  for (const std::string& path : options.coast) files.push_back({"--coast", path});
  for (const std::string& path : options.area) files.push_back({"--area", path});
  for (const std::string& path : options.lines) files.push_back({"--lines", path});
  files.push_back({"--depth", options.depth});
  files.push_back({"--elevation", options.elevation});
  return files;
}

// `facts` gets what is known of each file.
mesh::MeshDomain read_domain(const MeshTrianglesOptions& options, const Execution& execution,
                             std::vector<CellFacts>& facts) {
  std::vector<FileName> files;
  for (const auto* paths : {&options.coast, &options.area, &options.lines}) {
    for (const std::string& path : *paths) files.push_back({path, {}});
  }
  std::vector<FeatureTable> tables =
      read_features_together(files, options.sizes.polygons, execution);
  mesh::MeshDomain domain;
  LongitudeExtent of_area;
  LongitudeExtent of_others;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    tell(tables[k].facts.name, tables[k].facts.remarks);
    facts.push_back(std::move(tables[k].facts));
    auto& part = k < options.coast.size()                         ? domain.coast
                 : k < options.coast.size() + options.area.size() ? domain.area
                                                                  : domain.lines;
    LongitudeExtent& extent = &part == &domain.area ? of_area : of_others;
    for (const LongitudeExtent& one : tables[k].longitudes) extent.include(one);
    part.push_back({std::move(tables[k].lines), std::move(tables[k].polygons)});
  }
  domain.west_deg = west_of(of_area, of_others);
  return domain;
}

// Returns the corners of the area; none if it is the sphere.
std::vector<Point> corners_of_area(const mesh::MeshDomain& domain) {
  std::vector<Point> corners;
  for (const Geometries& area : domain.area) {
    if (!area.polygons.whole.empty()) return {};
    const std::vector<Point>& points = area.polygons.points;
    corners.insert(corners.end(), points.begin(), points.end());
  }
  return corners;
}

// Gives the nodes their depths of --depth or --elevation.
void set_depths(const MeshTrianglesOptions& options, mesh::TriangleMesh& mesh,
                const Execution& execution) {
  const bool is_up = options.depth.empty();
  const auto [file, name] = split_at_colon(is_up ? options.elevation : options.depth);
  std::vector<std::string> remarks;
  std::vector<double>& depths = mesh.depths;
  depths = mesh::read_heights({file, {}}, name, is_up ? mesh::Positive::up : mesh::Positive::down,
                              mesh.points, execution, &remarks);
  const auto is_other = [&](double value) { return is_up ? value > 0 : value < 0; };
  if (!depths.empty() && std::ranges::all_of(depths, is_other)) {
    remarks.emplace_back(is_up ? "--elevation: all nodes are above the sea; --depth reads depths"
                               : "--depth: all depths are negative; --elevation reads heights");
  }
  tell(file, remarks);
  if (is_up) {
    for (double& depth : depths) depth = depth == 0 ? 0 : -depth;
  }
  require_least_depth(options.least_depth, file, mesh);
}

// Returns the mesh with the border that its edges have, and its depths.
mesh::TriangleMesh mesh_of(const mesh::DomainTriangles& made, const MeshTrianglesOptions& options,
                           const Execution& execution) {
  mesh::TriangleMesh result = mesh::triangle_mesh(made);
  if (!options.depth.empty() || !options.elevation.empty()) {
    set_depths(options, result, execution);
  }
  return result;
}

void report_triangles(const MeshTrianglesOptions& options, const mesh::DomainTriangles& made,
                      const mesh::TriangleMesh& result, Job& job) {
  const mesh::RefineReport& refined = made.mesh.report;
  const double seconds = job.seconds().total;
  const double filled_km2 = made.filled_area * kilometers_per_radian * kilometers_per_radian;
  nlohmann::ordered_json json = json_of_triangles(result);
  json["filled_km2"] = filled_km2;
  json["small_parts"] = made.num_small_parts;
  json["lines_outside"] = made.lines_outside.size();
  json["near_small_angles"] = refined.num_near_small_angles;
  json["too_small"] = refined.num_too_small;
  json["seconds"] = seconds;
  std::array<char, 200> text{};
  std::string summary = text_of_triangles(result) + '\n';
  if (options.fill_narrow > 0) {
    std::snprintf(text.data(), text.size(), "filled %.6g km2 of narrow water\n", filled_km2);
    summary += text.data();
  }
  if (options.smallest_part > 0) {
    summary += count(made.num_small_parts, "small part is", "small parts are") + " left out\n";
  }
  if (const std::size_t number = made.lines_outside.size(); number > 0) {
    summary += count(number, "feature of --lines is", "features of --lines are") +
               " outside of the mesh\n";
  }
  const auto say = [&](std::size_t number, const std::string& why) {
    if (number == 0) return;
    summary += count(number, "triangle is", "triangles are") + " not as wanted " + why + '\n';
  };
  say(refined.num_near_small_angles, "near a small angle of coasts, borders or lines");
  say(refined.num_too_small, "where doubles have no place between corners");
  job.report(json.dump(2) + '\n',
             summary + "wrote " + options.common.output + " in " + text_of_seconds(seconds) + '\n');
}

// Returns the names of all files that the mesh is made of.
std::string names_of_features(const MeshTrianglesOptions& options) {
  std::set<std::string_view> known;
  std::string names;
  for (const auto* paths : {&options.coast, &options.area, &options.lines}) {
    for (const std::string& path : *paths) {
      if (!known.insert(path).second) continue;
      if (!names.empty()) names += ", ";
      names += path;
    }
  }
  return names.empty() ? "--spacing" : names;
}

// Throws FileError for files that cannot be read or written, and UsageError.
ExitStatus run_mesh_triangles(const MeshTrianglesOptions& options) {
  require_output(options.common, mesh::can_write_triangle_mesh(options.common.target()),
                 std::string(triangle_mesh_endings) + " .nc", files_read(options),
                 {{"--report", options.report}});
  if (options.coast.empty() && options.area.empty() && options.sizes.spacing.empty()) {
    throw UsageError("--coast, --area or --spacing says what triangles there shall be");
  }
  Job job(options.common);
  const Execution execution = job.execution();
  mesh::TrianglesOptions wanted;
  wanted.refine.smallest_angle_deg = options.angle;
  wanted.fill_narrow = options.fill_narrow;
  wanted.smallest_part = options.smallest_part;
  if (options.weld_km) wanted.weld = *options.weld_km / kilometers_per_radian;
  if (options.tolerance_km) wanted.tolerance = *options.tolerance_km / kilometers_per_radian;
  std::vector<CellFacts> facts;
  const mesh::MeshDomain domain = read_domain(options, execution, facts);
  wanted.refine.spacing =
      spacings_of(options.sizes, execution, mesh::region_of(domain), corners_of_area(domain));
  mesh::DomainTriangles made;
  mesh::TriangleMesh result;
  job.time(Stage::dual, [&] {
    try {
      made = mesh::triangles(domain, wanted, execution);
      result = mesh_of(made, options, execution);
    } catch (const InvalidInput& error) {
      throw FileError(names_of_features(options) + ": " + error.what());
    }
  });
  job.time(Stage::write, [&] {
    write_triangles_of(options.common, options.netcdf, result, options.common.output, job);
    write_triangle_report(options.report, result);
  });
  report_triangles(options, made, result, job);
  for (const CellFacts& file : facts) tell_of_properties(options.common, file);
  return done;
}

// Adds the files of what the mesh covers.
void add_domain(CLI::App& parser, MeshTrianglesOptions& options) {
  const auto add = [&parser](const char* name, std::vector<std::string>& files, const char* what) {
    parser.add_option(name, files, what)->allow_extra_args(false)->type_name("FILE");
  };
  add("--coast", options.coast,
      "Polygons of land, which the mesh leaves out: .geojson, with GDAL installed .gpkg\n"
      ".fgb .shp .parquet; may be repeated");
  add("--area", options.area,
      "Polygons inside of which the mesh is (default: everywhere); may be repeated");
  add("--lines", options.lines,
      "Lines, and sides of polygons, that edges follow; points are nodes; may be\n"
      "repeated");
  CLI::Option* const edges = add_edges_option(parser, options.sizes.polygons.edges, "these files");
  for (CLI::Option* const option :
       {edges, add_invalid_option(parser, options.sizes.polygons.invalid)}) {
    require_effect(
        options.common, option,
        [&options] {
          return !(options.coast.empty() && options.area.empty() && options.lines.empty() &&
                   options.sizes.refine.empty());
        },
        "without --coast, --area, --lines or --refine");
  }
}

void add_spacing(CLI::App& parser, MeshTrianglesOptions& options) {
  CLI::Option* const spacing = parser.add_option(
      "--spacing", options.sizes.spacing,
      "Length of edges: kilometers, or a file of them, FILE.nc[:NAME] or\n"
      "FILE.csv:COLUMN. No edge is longer than 1.5 times this (default: as long as\n"
      "angles allow)");
  spacing->type_name("KM|FILE");
  parser
      .add_option("--refine", options.sizes.refine,
                  "Kilometers near the lines, outlines or points of FILE, .geojson or a table;\n"
                  "may be repeated")
      ->allow_extra_args(false)
      ->needs(spacing)
      ->type_name("FILE:KM");
  const CLI::Option* const gradient =
      parser
          .add_option("--gradient", options.sizes.slope,
                      "How much the spacing grows over its own distance, at most\n"
                      "(default: 0.05 of --refine; files as they are)")
          ->check(positive_error)
          ->type_name("G");
  require_effect(
      options.common, gradient,
      [&options] {
        return !options.sizes.refine.empty() || is_file_of_spacings(options.sizes.spacing);
      },
      "without --refine or a file of --spacing");
  parser
      .add_option("--tolerance", options.tolerance_km,
                  "How far coasts, borders and lines of the mesh may be from those given;\n"
                  "islands and lakes that are nowhere wider vanish (default: a quarter of the\n"
                  "spacing, or 0)")
      ->check([](const std::string& text) { return range_error(text, 0, 5000); })
      ->type_name("KM");
  parser
      .add_option("--weld", options.weld_km,
                  "Put corners that are nearer than this to a corner or a side of another outline\n"
                  "there, as where rounded borders leave gaps (default: 1e-4 of the spacing, at\n"
                  "most the tolerance)")
      ->check([](const std::string& text) { return range_error(text, 0, 5000); })
      ->type_name("KM");
  parser
      .add_option("--angle", options.angle,
                  "The smallest angle of triangles, up to 33 degrees (default: 26.5)")
      ->check([](const std::string& text) { return range_error(text, 0, 33); })
      ->type_name("DEG");
  const auto add_share = [&parser](const char* name, double& share, const char* what) {
    return parser.add_option(name, share, what)
        ->check([](const std::string& text) { return range_error(text, 0, 1); })
        ->type_name("SHARE");
  };
  add_share("--fill-narrow", options.fill_narrow,
            "Make land of straits, coves and fjords that are narrower than this share of\n"
            "the spacing, which would have as short edges (default: 0)")
      ->needs(spacing);
  add_share("--smallest-part", options.smallest_part,
            "Leave out parts of the mesh that are smaller than this share of the largest\n"
            "one; 1 keeps that one alone (default: 0)");
}

}  // namespace

Command add_mesh_triangles_command(CLI::App& group) {
  auto options = std::make_shared<MeshTrianglesOptions>();
  CLI::App* parser = group.add_subcommand("triangles", "Fill an ocean with triangles");
  add_domain(*parser, *options);
  add_spacing(*parser, *options);
  CLI::Option* const depth = parser->add_option(
      "--depth", options->depth,
      "Depths at the nodes, in metres, interpolated in FILE.nc[:NAME], FILE.csv:COLUMN,\n"
      "FILE.geojson:PROPERTY, or of a mesh of triangles: FILE.14, or a folder of FESOM");
  depth->type_name("FILE");
  parser->add_option("--elevation", options->elevation, "The same, for heights above the sea")
      ->excludes(depth)
      ->type_name("FILE");
  CLI::Option* const least = add_least_depth_option(*parser, options->least_depth);
  require_effect(
      options->common, least,
      [given = options.get()] { return !given->depth.empty() || !given->elevation.empty(); },
      "without --depth or --elevation");
  add_output_option(*parser, options->common,
                    "Where to write the mesh: .msh (Gmsh; --format gmsh2 for 2.2) .14 (ADCIRC)\n"
                    ".gr3 .ll (SCHISM) .2dm (SMS) .nc (UGRID), or a folder with --format fesom")
      ->required();
  add_netcdf_options(*parser, options->common, options->netcdf, [given = options.get()] {
    return if_of_format(given->common.target(), {"nc", "nc4", "ugrid"});
  });
  add_mesh_report_option(*parser, options->report);
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "Edges follow coasts, borders and lines; each angle is at least the smallest one, except\n"
      "near places where these meet at less than 60 degrees. Coasts finer than the mesh are\n"
      "simplified first, without a change of topology. Longitudes are from -180 to 180 or in the\n"
      "turn of the input, as from 0 to 360: of --area, or else of --coast and --lines. Kilometers\n"
      "are those of a sphere of 6371.229 km. Spacings are kept on a raster: of a rectangle around\n"
      "--area with steps of half of the smallest spacing or of 1/4096 of its size; without an\n"
      "area, or for one that reaches farther than 45 degrees from its middle, of the sphere with\n"
      "steps of 7 km or more.\n\n"
      "Examples:\n"
      "  rondel mesh triangles --coast land.geojson --spacing 200 -o ocean.msh\n"
      "  rondel mesh triangles --coast land.geojson --spacing 200 --fill-narrow 0.5 "
      "--smallest-part 0.01 -o ocean.14\n"
      "  rondel mesh triangles --coast land.geojson --spacing 400 --refine coast.geojson:100 -o "
      "fort.14\n"
      "  rondel mesh triangles --coast land.geojson --area basins.geojson --spacing 50 -o "
      "hgrid.gr3");
  return {parser, [options] { return run_mesh_triangles(*options); }};
}

}  // namespace rondel::cli
