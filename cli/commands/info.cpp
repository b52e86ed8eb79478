// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel info: says what a file of sites holds: how many, in which coordinates and bounds, how many
// are in one place or hidden, which columns there are, and which commands take it.
// in    sites; a file whose sites are all in one place, or at the center, is described as well;
//       fields of netCDF; triangles in a format of ocean models; features with lines and polygons;
//       weights; the name of a grid
// out   text for people, or one JSON object
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>

#include "column_values.h"
#include "field_facts.h"
#include "job.h"
#include "other_facts.h"
#include "process.h"
#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/named_grids.h"
#include "targets.h"
#include "triangle_output.h"

namespace rondel::cli {
namespace {

using Json = nlohmann::ordered_json;

// The least and the largest of some numbers. It is empty until a number is added.
struct Range {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
  [[nodiscard]] bool is_empty() const { return min > max; }
};

// The range of a coordinate, in the unit of the file: degrees, or any unit of length.
struct NamedRange {
  const char* name;
  Range range;
};

// All that the report says beside the table itself.
struct Facts {
  std::vector<NamedRange> bounds;
  Range height;  // |p - center| - radius
  // The number of sites at the center of the sphere, which have no direction.
  std::size_t at_center = 0;
  Triangulation triangulation;  // of the sites that are not at the center
};

// Returns the bounds of the coordinates in which the sites were given.
std::vector<NamedRange> coordinate_bounds(const SiteTable& table) {
  if (table.is_lonlat()) {
    Range lon;
    Range lat;
    for (const LonLat& position : table.positions) {
      lon.add(position.lon_deg);
      lat.add(position.lat_deg);
    }
    return {{"lon", lon}, {"lat", lat}};
  }
  Range x;
  Range y;
  Range z;
  for (const Point& site : table.sites) {
    x.add(site.x);
    y.add(site.y);
    z.add(site.z);
  }
  return {{"x", x}, {"y", y}, {"z", z}};
}

// Returns also the bounds of the radii in degrees, if the sites are circles.
std::vector<NamedRange> bounds_of(const SiteTable& table) {
  std::vector<NamedRange> bounds = coordinate_bounds(table);
  if (table.radii_deg.empty()) return bounds;
  Range radius;
  for (const double radius_deg : table.radii_deg) radius.add(radius_deg);
  bounds.push_back({"radius", radius});
  return bounds;
}

// Returns the Euclidean length of a vector, 0 for the zero vector. The coordinates are scaled by
// the largest one, so that no square overflows or underflows.
double length(double x, double y, double z) {
  const double scale = std::max({std::abs(x), std::abs(y), std::abs(z)});
  if (scale == 0) return 0;
  x /= scale;
  y /= scale;
  z /= scale;
  return scale * std::sqrt(x * x + y * y + z * z);
}

// Returns the range of |p - center| - radius: how far sites are above (positive) or below the
// sphere.
Range heights_of(std::span<const Point> sites, const Sphere& sphere) {
  const Point& c = sphere.center;
  const double radius = std::sqrt(sphere.squared_radius);
  Range range;
  for (const Point& p : sites) {
    range.add(length(p.x - c.x, p.y - c.y, p.z - c.z) - radius);
  }
  return range;
}

// Returns the bounds, the heights and the triangulation. A site at the center of the sphere is
// counted, and left out of the triangulation, which would not accept it.
Facts find_facts(const SiteTable& table, Job& job, const Sphere& sphere) {
  Facts facts;
  facts.bounds = bounds_of(table);
  facts.height = heights_of(table.sites, sphere);
  SiteTable rays;
  rays.name = table.name;
  std::ranges::copy_if(table.sites, std::back_inserter(rays.sites),
                       [&](const Point& site) { return site != sphere.center; });
  facts.at_center = table.sites.size() - rays.sites.size();
  facts.triangulation = job.triangulate(rays);
  return facts;
}

// Returns null for a range without numbers, since JSON has no infinities.
Json json_of(const Range& range) {
  if (range.is_empty()) return nullptr;
  return {{"min", range.min}, {"max", range.max}};
}

// Returns null if there are no sites.
Json json_of_coordinates(const SiteTable& table) {
  if (table.sites.empty()) return nullptr;
  return table.is_lonlat() ? "lonlat" : "xyz";
}

// Returns the object of --json. Names of columns that are not UTF-8 are mended by the replacement
// character.
std::string json_of(const SiteTable& table, const Facts& facts,
                    const std::optional<FieldSet>& fields, const std::optional<FieldSet>& elsewhere,
                    const Seconds& seconds) {
  Json bounds = Json::object();
  for (const auto& [name, range] : facts.bounds) bounds[name] = json_of(range);
  const Triangulation& triangulation = facts.triangulation;
  Json json = {{"sites", table.sites.size()},
               {"coordinates", json_of_coordinates(table)},
               {"circles", !table.radii_deg.empty()},
               {"bounds", bounds},
               {"distance_from_sphere", json_of(facts.height)},
               {"at_center", facts.at_center},
               {"duplicates", triangulation.duplicates().size()},
               {"hidden", triangulation.hidden().size()},
               {"unlocated", table.num_unlocated},
               {"dimension", triangulation.dimension()},
               {"model", name_of(triangulation.model())},
               {"columns", json_of_columns(table.columns)},
               {"seconds", {{"read", seconds.read}, {"total", seconds.total}}},
               {"peak_memory_bytes", peak_memory_bytes()}};
  if (fields) add_facts_of(*fields, json);
  if (elsewhere) {
    json["elsewhere"] = {{"places", elsewhere->num_points}};
    add_facts_of(*elsewhere, json["elsewhere"]);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

// Returns a line with 9 digits; nothing for an empty range.
std::string text_of(const char* name, const Range& range) {
  if (range.is_empty()) return {};
  char text[128];
  std::snprintf(text, sizeof text, "%s: %.9g to %.9g\n", name, range.min, range.max);
  return text;
}

// Returns an empty text if there are no sites, since the table then does not say which coordinates
// it has.
std::string coordinates_of(const SiteTable& table) {
  if (table.sites.empty()) return {};
  const std::string given = ", given as ";
  if (table.radii_deg.empty()) {
    return given + (table.is_lonlat() ? "longitude and latitude" : "x, y, z");
  }
  return given + (table.is_lonlat() ? "longitude, latitude and radius" : "x, y, z and radius");
}

// Returns the name of the first column of numbers that are no coordinates; nothing if there is none.
std::string name_of_values(const SiteTable& table, const CommonOptions& common) {
  static constexpr std::string_view coordinates[] = {
      "lon", "lng", "long", "longitude", "lat", "latitude", "x", "y", "z", "radius"};
  const ReadOptions& read = common.read;
  const std::string_view given[] = {read.lon, read.lat, read.x, read.y, read.z, read.radius};
  const bool has_coordinates = !is_netcdf_file(common.source());
  for (const Column& column : table.columns) {
    std::string name = column.name;
    std::ranges::transform(name, name.begin(), [](unsigned char c) {
      return c < 0x80 ? static_cast<char>(std::tolower(c)) : static_cast<char>(c);
    });
    const bool is_coordinate = has_coordinates && (std::ranges::count(coordinates, name) > 0 ||
                                                   std::ranges::count(given, column.name) > 0);
    if (!is_coordinate && holds_numbers(column)) return column.name;
  }
  return {};
}

// Returns the fields of a netCDF file at the sites, without their values; nothing if it is a file of
// another format, or has none.
std::optional<FieldSet> fields_of(const SiteTable& table, const CommonOptions& common) {
  if (!is_netcdf_file(common.source())) return std::nullopt;
  try {
    const auto [file, variable] = file_and_variable(common.source());
    std::vector<std::string> names;
    if (!variable.empty()) names = {variable};
    const FieldFile fields(file, names, table.sites.size(), {}, {}, WantedPlaces{table.positions});
    return fields.fields();
  } catch (const FileError&) {
    return std::nullopt;  // a mesh may have no fields
  }
}

// Returns a name as a word of a command: in quotes if a shell would divide or change it.
std::string as_word(const std::string& name) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c >= 0x80 ||
           std::string_view("_-+.,:@%/").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!name.empty() && std::ranges::all_of(name, is_plain)) return name;
  std::string word = "'";
  for (const char c : name) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + '\'';
}

// Returns the lines that say what to do with the sites; none if there are no sites.
std::string commands_for(const SiteTable& table, const std::optional<FieldSet>& fields,
                         const std::optional<FieldSet>& elsewhere, const CommonOptions& common) {
  if (table.sites.empty()) return {};
  std::string text = "commands that take it: delaunay, voronoi, regions, nearest, graph, plot\n";
  std::string values = name_of_values(table, common);
  if (values.empty() && fields) values = first_field_of(*fields);
  if (values.empty() && elsewhere) values = first_field_of(*elsewhere);
  if (!values.empty()) text += "and with --value " + as_word(values) + ": interpolate, contours\n";
  if (is_netcdf_file(common.source())) {
    text += "and if its values are on cells: regrid, remap";
    const bool are_triangles = mesh::is_ugrid_of_triangles(common.source());
    text += are_triangles ? "\nand as triangles: mesh convert, mesh quality\n" : ", mesh quality\n";
  }
  return text;
}

// Returns the report for people.
std::string text_of(const SiteTable& table, const Facts& facts,
                    const std::optional<FieldSet>& fields, const std::optional<FieldSet>& elsewhere,
                    const CommonOptions& common) {
  const Triangulation& triangulation = facts.triangulation;
  std::string text =
      table.name + ": " + count(table.sites.size(), "site", "sites") + coordinates_of(table) + '\n';
  for (const auto& [name, range] : facts.bounds) text += text_of(name, range);
  text += text_of("distance from the sphere", facts.height);
  if (facts.at_center > 0) text += "at the center: " + std::to_string(facts.at_center) + '\n';
  text += "duplicates: " + std::to_string(triangulation.duplicates().size()) + '\n';
  if (triangulation.model() == Model::weighted) {
    text += "hidden: " + std::to_string(triangulation.hidden().size()) + '\n';
  }
  // The fields of netCDF are variables, those with one value at each site among them.
  text += fields ? lines_of_fields(*fields) : line_of_columns(table.columns);
  if (elsewhere) {
    text += "at " + count(elsewhere->num_points, "other place", "other places") +
            ", such as nodes:\n" + lines_of_fields(*elsewhere);
  }
  return text + commands_for(table, fields, elsewhere, common);
}

// Returns the nodes in degrees.
std::vector<LonLat> places_of(const mesh::TriangleMesh& mesh) {
  return mesh.positions.empty() ? lonlats(mesh.points) : mesh.positions;
}

// Returns the report on a mesh of triangles.
std::string text_of(const std::string& name, const mesh::TriangleMesh& mesh, const Range& depth) {
  Range lon;
  Range lat;
  for (const auto& [lon_deg, lat_deg] : places_of(mesh)) {
    lon.add(lon_deg);
    lat.add(lat_deg);
  }
  return name + ": " + text_of_triangles(mesh) + '\n' + text_of("lon", lon) + text_of("lat", lat) +
         text_of("depth", depth) +
         (mesh.levels.empty() ? "" : "levels: " + std::to_string(mesh.levels.size()) + '\n') +
         "commands that take it: mesh convert, mesh quality\n";
}

// Prints what a mesh of triangles has. Throws FileError for a file that cannot be read.
ExitStatus run_info_of_triangles(const CommonOptions& common) {
  Job job(common);
  const mesh::TriangleMesh mesh = read_triangles_of(common, job);
  Range depth;
  for (const double value : mesh.depths) depth.add(value);
  Json json = json_of_triangles(mesh);
  json["depth"] = json_of(depth);
  json["levels"] = mesh.levels.size();
  json["pinched_nodes"] = mesh::pinched_nodes(mesh);
  job.report(json.dump(2) + '\n', text_of(common.input, mesh, depth));
  return done;
}

// Says what the name of a grid means.
ExitStatus run_info_of_grid(const CommonOptions& common) {
  Job job(common);
  const NamedGrid grid = grid_of(common.input);
  const Json json = {
      {"cells", grid.num_cells()}, {"grid", grid.shape()}, {"covers_sphere", grid.covers_sphere()}};
  std::string text = common.input + ": a grid of " + count(grid.num_cells(), "cell", "cells");
  for (std::size_t d = 0; grid.shape().size() > 1 && d < grid.shape().size(); ++d) {
    text += (d == 0 ? ", " : " x ") + std::to_string(grid.shape()[d]);
  }
  job.report(json.dump(2) + '\n',
             text + (grid.covers_sphere() ? "\n" : ", which do not cover the sphere\n") +
                 "commands that take it in place of a file: regrid, remap, check-weights\n"
                 "and with --to: interpolate\n");
  return done;
}

// What is read, for a message.
constexpr std::string_view read_formats =
    "sites are read from .csv .tsv .xyz .txt .npy .geojson .gpkg .fgb .shp .parquet, fields and "
    "meshes from netCDF, triangles from .msh .14 .gr3 .ll .2dm, features from .geojson, weights "
    "from "
    ".nc .npz";

// Returns whether an ending says what a file holds: the message has it, or it is another one of
// netCDF or GeoJSON.
bool is_known_ending(const std::string& ending) {
  static constexpr std::string_view others[] = {"nc4", "cdf", "ncf", "json"};
  const std::string text = std::string(read_formats) + ' ';
  return text.find(" ." + ending + ' ') != std::string::npos ||
         text.find(" ." + ending + ',') != std::string::npos ||
         std::ranges::count(others, ending) > 0;
}

// Throws FileError for a file whose name does not say what it holds, with all that it may hold.
void require_known_ending(const CommonOptions& common) {
  const std::string format = format_of(common.source());
  std::error_code error;
  if (common.input == "-" || !std::filesystem::exists(common.input, error)) return;
  if (is_known_ending(format) || is_netcdf_file(common.source())) return;
  const std::string what = format.empty()                   ? "the name has no ending"
                           : common.source().format.empty() ? "unknown ending \"." + format + '"'
                                                            : "unknown format \"" + format + '"';
  throw FileError(common.input + ": " + what + "; " + std::string(read_formats));
}

// Reads the sites with all columns, triangulates them to count duplicates and hidden sites, and
// prints the facts. No file is written. Throws FileError for a file that cannot be read.
ExitStatus run_info(const CommonOptions& options) {
  std::error_code ignored;
  if (NamedGrid::is_name(options.input) && !std::filesystem::exists(options.input, ignored)) {
    return run_info_of_grid(options);
  }
  if (is_triangle_input(options)) return run_info_of_triangles(options);
  CommonOptions common = options;
  common.read.keep_columns = true;
  Job job(common);
  SiteTable table;
  try {
    table = job.read();
  } catch (const FileError&) {
    std::error_code error;
    if (std::filesystem::is_fifo(common.input, error)) throw;  // which cannot be read again
    require_known_ending(common);
    const std::optional<OtherFacts> others = other_facts_of(common, job);
    if (!others) throw;
    job.report(others->json, others->text);
    return done;
  }
  const Facts facts = find_facts(table, job, common.build.sphere);
  const std::optional<FieldSet> fields = fields_of(table, common);
  std::optional<FieldSet> elsewhere;
  if (!fields && is_netcdf_file(common.source())) {
    elsewhere = fields_elsewhere(common.source(), table);
  }
  job.report(json_of(table, facts, fields, elsewhere, job.seconds()),
             text_of(table, facts, fields, elsewhere, common));
  return done;
}

}  // namespace

Command add_info_command(CLI::App& tool) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App* parser =
      tool.add_subcommand("info", "Say what a file holds and which commands take it");
  add_input_options(*parser, *options);
  add_build_options(*parser, *options);
  add_report_options(*parser, *options);
  parser->footer(
      "Prints the number of sites, their bounds, exact duplicates, the distance from\n"
      "the sphere, the columns, and the commands that take the file. Of triangles (.msh .14 .gr3 "
      ".ll .2dm, a folder of FESOM):\n"
      "the numbers of nodes, triangles and segments of the border, bounds and depths. Of\n"
      "features with lines and polygons (.geojson) and of weights (.nc .npz): their numbers. Of "
      "netCDF\n"
      "also the fields, the lengths of their dimensions, and what would be left out. Of the name "
      "of a\n"
      "grid: its cells.\n\n"
      "Example:\n"
      "  rondel info stations.csv\n"
      "  rondel info healpix:7\n"
      "  rondel info hgrid.gr3");
  return {parser, [options] { return run_info(*options); }};
}

}  // namespace rondel::cli
