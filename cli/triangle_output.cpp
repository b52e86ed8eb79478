// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "triangle_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "column_values.h"
#include "report.h"
#include "rondel/constrained_features.h"
#include "rondel/error.h"
#include "validate.h"

namespace rondel::cli {
namespace {

constexpr std::array<mesh::BoundaryKind, 3> all_kinds = {
    mesh::BoundaryKind::open, mesh::BoundaryKind::land, mesh::BoundaryKind::island};

std::size_t number_of(mesh::BoundaryKind kind, const mesh::TriangleMesh& mesh) {
  return static_cast<std::size_t>(
      std::ranges::count(mesh.boundary, kind, &mesh::BoundarySegment::kind));
}

// Tells of nodes that models refuse, by the numbers that files give them.
void tell_of_pinched(const std::string& file, const mesh::TriangleMesh& mesh) {
  const std::vector<Index> pinched = mesh::pinched_nodes(mesh);
  if (pinched.empty()) return;
  const std::string first = "node " + std::to_string(pinched.front() + 1) + " (from 1)";
  tell(file, {pinched.size() == 1
                  ? first + " has several gaps between its triangles, which models refuse"
                  : first + " and " + std::to_string(pinched.size() - 1) +
                        " more have several gaps between their triangles, which models refuse"});
}

// Tells the names of what a file has for its sites or features and OUTPUT does not have, the first of
// many, unless OUTPUT is indices of sites.
void tell_of_left_out(const CommonOptions& common, const std::string& file, const char* what,
                      const std::vector<std::string>& names) {
  constexpr std::size_t most = 12;
  if (names.empty() || common.format() == "npy") return;
  std::string text = what + std::string(" that the output does not have: ") + names.front();
  for (std::size_t k = 1; k < std::min(names.size(), most); ++k) text += ", " + names[k];
  if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
  tell(file, {text});
}

}  // namespace

bool is_triangle_input(const CommonOptions& common) {
  return mesh::is_triangle_mesh_file(common.source()) && !is_netcdf_file(common.source());
}

bool has_triangles_alone(const CommonOptions& common) {
  return is_triangle_input(common) || mesh::is_ugrid_of_triangles(common.source());
}

mesh::TriangleMesh read_triangles_of(const CommonOptions& common, Job& job) {
  mesh::TriangleMesh mesh;
  std::vector<std::string> remarks;
  job.time(Stage::dual,
           [&] { mesh = mesh::read_triangle_mesh(common.source(), job.execution(), &remarks); });
  tell(common.source().path, remarks);
  return mesh;
}

CLI::Option* add_least_depth_option(CLI::App& parser, std::optional<double>& least_depth) {
  return parser
      .add_option("--least-depth", least_depth,
                  "Metres that each node has at least, as models need at coasts, where files\n"
                  "have heights of land (default: depths as they are, which FESOM refuses if\n"
                  "one is negative)")
      ->check(finite_error)
      ->type_name("M");
}

void require_least_depth(const std::optional<double>& least_depth, const std::string& source,
                         mesh::TriangleMesh& mesh) {
  if (!least_depth) return;
  std::size_t number = 0;
  try {
    number = mesh::deepen(mesh, *least_depth);
  } catch (const InvalidInput& error) {
    throw FileError(source + ": --least-depth: " + error.what());
  }
  if (number == 0) return;
  tell(source, {"--least-depth: " + count(number, "node is", "nodes are") + " less deep in it"});
}

void leave_out_flat_triangles(const CommonOptions& common, std::span<const Point> sites,
                              std::span<const LonLat> positions,
                              std::span<const std::array<Index, 2>> constraints,
                              const std::string& source, std::vector<Triple>& triangles) {
  if (!mesh::has_nodes_in_degrees(common.target())) return;
  const std::vector<LonLat> short_ones =
      positions.empty() ? short_lonlats(sites) : std::vector<LonLat>();
  const std::size_t number =
      mesh::leave_out_flat(positions.empty() ? short_ones : positions, triangles, constraints);
  if (number == 0) return;
  const std::string flat = count(number, "triangle", "triangles") + " on the border ";
  const std::string why = " area in degrees, as the sites are on one line";
  const char* const have = number == 1 ? "has" : "have";
  if (triangles.empty()) throw FileError(source + ": no triangle has an" + why);
  tell(source, {flat + (number == 1 ? "is" : "are") + " left out, which " + have + " no" + why});
}

void write_triangles_of(const CommonOptions& common, const NetcdfOptions& netcdf,
                        const mesh::TriangleMesh& mesh, const std::string& source, Job& job) {
  std::vector<std::string> remarks;
  job.time(Stage::write, [&] {
    try {
      mesh::write_triangle_mesh(common.target(), mesh, netcdf, job.execution(), &remarks);
    } catch (const InvalidInput& error) {
      throw FileError(source + ": " + error.what());
    }
  });
  tell(common.output, remarks);
  tell_of_pinched(source, mesh);
}

std::vector<double> depths_of_sites(const CommonOptions& common, const SiteTable& table) {
  std::vector<double> depths;
  std::vector<std::string> left_out;
  const bool is_for_model = mesh::can_write_triangle_mesh(common.target());
  for (const std::string& name : value_columns(table, common.read)) {
    const bool are_depths = name == "depth" || name == "Depth" || name == "DEPTH";
    if (are_depths && is_for_model && depths.empty()) {
      depths = column_values(table, name, "--output");
    } else {
      left_out.push_back(name);
    }
  }
  const auto missing = std::ranges::find_if(depths, [](double depth) { return std::isnan(depth); });
  if (missing != depths.end()) {
    throw FileError(table.where(static_cast<std::size_t>(missing - depths.begin())) +
                    ": the site has no depth");
  }
  tell_of_left_out(common, table.name, "columns", left_out);
  return depths;
}

void tell_of_properties(const CommonOptions& common, const CellFacts& facts) {
  std::vector<std::string> names;
  for (const Column& column : facts.columns) names.push_back(column.name);
  tell_of_left_out(common, facts.name, "properties", names);
}

void write_triangle_report(const std::string& path, const mesh::TriangleMesh& mesh) {
  if (path.empty()) return;
  const std::string format = format_of(path);
  if (format == "svg") {
    write_file(path, mesh::quality_picture(mesh));
  } else {
    write_file(path, format == "txt" ? text_of_triangles(mesh) + '\n'
                                     : json_of_triangles(mesh).dump(2) + '\n');
  }
}

nlohmann::ordered_json json_of_triangles(const mesh::TriangleMesh& mesh) {
  nlohmann::ordered_json segments;
  for (const mesh::BoundaryKind kind : all_kinds) {
    segments[std::string(name_of(kind))] = number_of(kind, mesh);
  }
  const mesh::TriangleQuality quality = mesh::triangle_quality(mesh);
  return {{"nodes", mesh.points.size()},
          {"triangles", mesh.triangles.size()},
          {"segments", segments},
          {"smallest_angle", quality.smallest_angle_deg},
          {"shortest_edge_km", quality.shortest_edge * kilometers_per_radian},
          {"longest_edge_km", quality.longest_edge * kilometers_per_radian}};
}

std::string text_of_triangles(const mesh::TriangleMesh& mesh) {
  std::string text = count(mesh.points.size(), "node", "nodes") + ", " +
                     count(mesh.triangles.size(), "triangle", "triangles") + "; border:";
  for (const mesh::BoundaryKind kind : all_kinds) {
    text += (kind == all_kinds.front() ? " " : ", ") + std::to_string(number_of(kind, mesh)) + ' ' +
            std::string(name_of(kind));
  }
  const mesh::TriangleQuality quality = mesh::triangle_quality(mesh);
  std::array<char, 120> line{};
  std::snprintf(line.data(), line.size(),
                "\nedges from %.4g to %.4g km; the smallest angle is %.2f degrees",
                quality.shortest_edge * kilometers_per_radian,
                quality.longest_edge * kilometers_per_radian, quality.smallest_angle_deg);
  return text + line.data();
}

}  // namespace rondel::cli
