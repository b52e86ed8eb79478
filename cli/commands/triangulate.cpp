// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel triangulate: triangulates sites with given edges.
// in    points, lines and polygons; or sites and pairs of them
// out   triangles
// index places of the features in their order, each once, or sites in the order of the input; sites
//       that are added where constraints cross come after them
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "edge_table.h"
#include "job.h"
#include "report.h"
#include "rondel/constrained.h"
#include "rondel/constrained_features.h"
#include "rondel/delaunay.h"
#include "rondel/geometries.h"
#include "rondel/triangle_files.h"
#include "triangle_output.h"

namespace rondel::cli {
namespace {

// The options of `rondel triangulate`.
struct TriangulateOptions {
  CommonOptions common;
  std::string constraints;  // --constraints; empty: INPUT has features
  bool is_split = false;    // --split
  bool is_inside = false;   // --inside
  PolygonOptions read;
};

// What is triangulated.
struct Plan {
  SiteTable table;
  EdgeTable edges;                 // whose places are "coast.geojson: feature 3" or those of lines
  CompressedRows<Index> polygons;  // the sides of each feature's, which are constraints
  std::vector<std::string> names;  // of each feature, for messages
  double west_deg = -180;          // where the turn of the longitudes begins
  CellFacts facts;                 // of the features
};

// Reads features. Throws FileError.
Plan plan_of_features(const TriangulateOptions& options, const Execution& execution) {
  const FileName file = options.common.source();
  FeatureTable features =
      std::move(read_features_together({&file, 1}, options.read, execution).front());
  tell(features.facts.name, features.facts.remarks);
  Plan plan;
  plan.table.name = features.facts.name;
  const auto place = [&](std::size_t f) {
    return plan.table.name + ": feature " + std::to_string(f);
  };
  FeatureConstraints made;
  try {
    made = constraints_of_features(features.lines, features.polygons);
  } catch (const InvalidInput& error) {
    throw FileError(plan.table.name + ": " + error.what());
  }
  for (const Index feature : made.features) plan.edges.places.push_back(place(feature));
  for (std::size_t f = 0; f < made.polygons.size(); ++f) plan.names.push_back(place(f));
  plan.table.sites = std::move(made.sites);
  LongitudeExtent given;
  for (const LongitudeExtent& one : features.longitudes) given.include(one);
  plan.west_deg = west_of(given);
  plan.table.positions = short_lonlats(plan.table.sites, plan.west_deg);
  plan.edges.constraints = std::move(made.constraints);
  plan.polygons = std::move(made.polygons);
  plan.facts = std::move(features.facts);
  return plan;
}

// Returns the faces that are in any polygon, ascending.
std::vector<Index> faces_in_polygons(const ConstrainedTriangulation& result, const Plan& plan) {
  std::vector<Index> faces;
  try {
    faces = faces_inside(result, plan.edges.constraints, plan.polygons).values;
  } catch (const InvalidInput& error) {
    const bool has_name = error.index() < plan.names.size();
    throw FileError((has_name ? plan.names[error.index()] : plan.table.name) + ": " + error.what());
  }
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

Plan plan_of(const TriangulateOptions& options, Job& job) {
  if (options.constraints.empty()) return plan_of_features(options, job.execution());
  Plan plan;
  plan.table = job.read();
  plan.edges = read_edge_table(options.constraints, plan.table);
  LongitudeExtent given;
  for (const LonLat& place : plan.table.positions) given.include({place.lon_deg, place.lon_deg});
  plan.west_deg = west_of(given);
  return plan;
}

// Triangulates, and gives the table the sites that were added.
ConstrainedTriangulation triangulated(const TriangulateOptions& options, Plan& plan,
                                      const Execution& execution) {
  const auto crossings =
      options.is_split ? ConstraintCrossings::split : ConstraintCrossings::refuse;
  ConstrainedTriangulation result =
      with_edges(plan.edges, plan.table.name, "; --split makes a site there", [&] {
        return constrained_delaunay(Sites(plan.table.sites), plan.edges.constraints,
                                    {.crossings = crossings}, execution);
      });
  const auto sites = result.triangulation.sites().points();
  const auto added = sites.subspan(plan.table.sites.size());
  if (!plan.table.positions.empty()) {
    const std::vector<LonLat> positions = short_lonlats(added, plan.west_deg);
    plan.table.positions.insert(plan.table.positions.end(), positions.begin(), positions.end());
  }
  plan.table.sites.insert(plan.table.sites.end(), added.begin(), added.end());
  return result;
}

// True if OUTPUT is a mesh of an ocean model.
bool is_for_model(const CommonOptions& common) {
  return mesh::can_write_triangle_mesh(common.target());
}

void require_input(const TriangulateOptions& options) {
  const CommonOptions& common = options.common;
  require_output(common, can_write_triangles(common.target()) || is_for_model(common),
                 ".npy .off .ply .obj .stl .vtp .geojson .nc " + std::string(triangle_mesh_endings),
                 {{"--constraints", options.constraints}});
  if (options.constraints.empty() && !may_have_features(common.source())) {
    throw UsageError("INPUT: without --constraints '" + common.input +
                     "' must be .geojson or a format of GDAL, whose lines and polygons are the "
                     "constraints");
  }
  if (!options.constraints.empty()) require_edge_table(options.constraints);
}

// Gives sites at crossings depths between those of the ends of a constraint that they are on, of the
// first one of several.
void add_depths_of_crossings(const Plan& plan, const ConstrainedTriangulation& result,
                             std::vector<double>& depths) {
  const std::size_t num_given = depths.size();
  if (num_given == 0) return;
  const auto sites = result.triangulation.sites().points();
  std::vector<Index> constraint_of(sites.size(), no_index);
  for (std::size_t e = 0; e < result.edges.size(); ++e) {
    for (const Index site : result.edges[e]) {
      constraint_of[site] = std::min(constraint_of[site], result.sources[e].front());
    }
  }
  const auto distance = [&](std::size_t p, std::size_t q) {
    return std::hypot(sites[p].x - sites[q].x, sites[p].y - sites[q].y, sites[p].z - sites[q].z);
  };
  depths.resize(sites.size());
  for (std::size_t s = num_given; s < sites.size(); ++s) {
    if (constraint_of[s] == no_index) continue;
    const auto& [a, b] = plan.edges.constraints[constraint_of[s]];
    const double share = distance(s, a) / (distance(s, a) + distance(s, b));
    depths[s] = (1 - share) * depths[a] + share * depths[b];
  }
  for (const Duplicate& d : result.triangulation.duplicates()) {
    if (d.site >= num_given) depths[d.site] = depths[d.representative];
  }
}

// Names the first site that has another depth than the site in its place that is the node.
void tell_of_lost_depths(const SiteTable& table, std::span<const Duplicate> duplicates,
                         std::span<const double> depths) {
  std::size_t number = 0;
  const Duplicate* first = nullptr;
  for (const Duplicate& d : duplicates) {
    if (d.site >= depths.size() || depths[d.site] == depths[d.representative]) continue;
    if (number++ == 0) first = &d;
  }
  if (number == 0) return;
  tell(table.where(first->site),
       {"the depth is not that of " + table.where(first->representative) +
        " in the same place, which counts (" + count(number, "site", "sites") + " in all)"});
}

// Writes solid faces as a mesh: those in `inside`, or all. Edges that are constraints are coast.
// Returns the number of faces.
std::size_t write_for_model(const CommonOptions& common, const Plan& plan,
                            const ConstrainedTriangulation& result,
                            const std::vector<Index>* inside, std::span<const double> depths,
                            Job& job) {
  const Triangulation& triangulation = result.triangulation;
  std::vector<Triple> triangles;
  for (Index f = 0; f < triangulation.num_faces(); ++f) {
    const bool is_wanted =
        inside != nullptr ? std::ranges::binary_search(*inside, f) : !triangulation.is_ghost(f);
    if (is_wanted) triangles.push_back(triangulation.faces()[f]);
  }
  if (triangles.empty()) throw FileError(plan.table.name + ": there are no triangles");
  leave_out_flat_triangles(common, plan.table.sites, plan.table.positions, result.edges,
                           plan.table.name, triangles);
  tell_of_lost_depths(plan.table, triangulation.duplicates(), depths);
  const mesh::TriangleMesh mesh =
      mesh::triangle_mesh(plan.table.sites, plan.table.positions, triangles, result.edges, depths);
  write_triangles_of(common, {}, mesh, plan.table.name, job);
  return mesh.triangles.size();
}

// Writes the faces in `inside`, or all.
void write_faces(const CommonOptions& common, const SiteTable& table,
                 const Triangulation& triangulation, const std::vector<Index>* inside, Job& job) {
  std::vector<std::string> remarks;
  job.time(Stage::write, [&] {
    if (inside != nullptr) {
      write_some_triangles(common.target(), table, triangulation, *inside, job.execution(),
                           &remarks);
    } else {
      write_triangles(common.target(), table, triangulation, job.execution(), &remarks);
    }
  });
  tell(common.output, remarks);
}

// Throws FileError for files that cannot be read or written, and constraints that cross; UsageError.
ExitStatus run_triangulate(TriangulateOptions options) {
  require_input(options);
  options.common.read.keep_columns = !is_netcdf_file(options.common.source());
  Job job(options.common);
  Plan plan = plan_of(options, job);
  if (options.is_inside && plan.polygons.values.empty()) {
    throw FileError(plan.table.name + ": there are no polygons, in which --inside wants the faces");
  }
  const std::size_t num_given = plan.table.sites.size();
  ConstrainedTriangulation result;
  std::vector<Index> inside;
  job.time(Stage::dual, [&] {
    result = triangulated(options, plan, job.execution());
    if (options.is_inside) inside = faces_in_polygons(result, plan);
  });
  std::vector<double> depths = depths_of_sites(options.common, plan.table);
  add_depths_of_crossings(plan, result, depths);
  const Triangulation& triangulation = result.triangulation;
  const std::vector<Index>* const wanted = options.is_inside ? &inside : nullptr;
  std::size_t num_for_model = 0;
  if (is_for_model(options.common)) {
    num_for_model = write_for_model(options.common, plan, result, wanted, depths, job);
  } else {
    write_faces(options.common, plan.table, triangulation, wanted, job);
  }
  const std::size_t num_sites = plan.table.sites.size();
  const std::size_t num_added = num_sites - num_given;
  // Files for models have no ghost faces, nor have those of faces in polygons.
  const bool has_ghosts = !options.is_inside && !is_for_model(options.common);
  const std::size_t num_ghosts = has_ghosts ? triangulation.num_ghost_faces() : 0;
  const std::size_t num_solid = triangulation.num_faces() - triangulation.num_ghost_faces();
  const std::size_t num_faces = is_for_model(options.common) ? num_for_model
                                : options.is_inside          ? inside.size()
                                                             : num_solid + num_ghosts;
  const double seconds = job.seconds().total;
  job.report(nlohmann::ordered_json{{"sites", num_sites},
                                    {"added_sites", num_added},
                                    {"constraints", plan.edges.constraints.size()},
                                    {"edges", result.edges.size()},
                                    {"faces", num_faces},
                                    {"ghost_faces", num_ghosts},
                                    {"seconds", seconds}}
                     .dump(2) +
                 '\n',
             count(num_sites, "site", "sites") + ", " + std::to_string(num_added) +
                 " of them added where constraints cross\n" +
                 count(plan.edges.constraints.size(), "constraint", "constraints") + ": " +
                 count(result.edges.size(), "edge", "edges") + "\nwrote " +
                 count(num_faces, "face", "faces") + " to " + options.common.output + " in " +
                 text_of_seconds(seconds) + '\n');
  tell_of_properties(options.common, plan.facts);
  return done;
}

}  // namespace

Command add_triangulate_command(CLI::App& tool) {
  auto options = std::make_shared<TriangulateOptions>();
  CLI::App* parser = tool.add_subcommand(
      "triangulate", "Triangulate points, lines and polygons, whose sides are edges");
  const auto has_table = [given = options.get()] { return !given->constraints.empty(); };
  add_input_options(
      *parser, options->common,
      "The features: .geojson, with GDAL installed .gpkg .fgb .shp .parquet; with\n"
      "--constraints sites: .csv .tsv .xyz .txt .npy .geojson, the places of a netCDF\n"
      "file; or - for standard input");
  parser
      ->add_option("--constraints", options->constraints,
                   "The edges between sites: .csv, two columns of indices of sites from 0")
      ->type_name("FILE");
  add_output_option(
      *parser, options->common,
      "Where to write the triangles: .npy (m x 3 indices) .off .ply .obj .stl .vtp\n"
      ".geojson. Or as a mesh of ocean models, whose coast are the constraints: .msh\n"
      ".14 .gr3 .ll .2dm .nc (UGRID), --format fesom (a folder)")
      ->required();
  parser->add_flag("--split", options->is_split,
                   "Make a site where constraints cross, which is an error otherwise");
  CLI::Option* inside =
      parser->add_flag("--inside", options->is_inside, "Write the faces in polygons alone");
  CLI::Option* edges = add_edges_option(*parser, options->read.edges);
  CLI::Option* invalid = add_invalid_option(*parser, options->read.invalid);
  for (const char* name : {"--delimiter", "--lon", "--lat", "--x", "--y", "--z", "--radians"}) {
    require_effect(options->common, parser->get_option(name), has_table, "without --constraints");
  }
  require_effect(
      options->common, parser->get_option("--radius"), [] { return false; },
      "as sites of this command are points");
  for (CLI::Option* option : {inside, edges, invalid}) {
    require_effect(
        options->common, option, [has_table] { return !has_table(); }, "with --constraints");
  }
  add_threads_option(*parser, options->common);
  add_report_options(*parser, options->common);
  parser->footer(
      "The constrained Delaunay triangulation: each constraint is a chain of edges, divided at\n"
      "sites that lie on it, and everything else is Delaunay as far as constraints let sites see\n"
      "each other. It is exact and unique. Sites are the points of features, their corners and\n"
      "those that straight lines in longitude and latitude need; each place is one site. A mesh\n"
      "of ocean models has the depths of a column 'depth' beside the sites of --constraints, at\n"
      "crossings one between those of the ends of a constraint, and longitudes from -180 to 180\n"
      "or in the turn of the input, as from 0 to 360. Triangles on its border that have no area\n"
      "in degrees, as on a meridian, are left out.\n\n"
      "Examples:\n"
      "  rondel triangulate coast.geojson -o mesh.ply\n"
      "  rondel triangulate lakes.geojson --inside --split -o lakes.vtp\n"
      "  rondel triangulate sea.geojson --inside -o hgrid.gr3\n"
      "  rondel triangulate stations.csv --constraints faults.csv -o faces.npy");
  return {parser, [options] { return run_triangulate(*options); }};
}

}  // namespace rondel::cli
