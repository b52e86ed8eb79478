// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Meshes of triangles and their files.

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "mesh_sizes.h"
#include "module.h"
#include "named.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_triangles.h"
#include "rondel/triangle_files.h"

namespace rondel::python {
namespace {

using mesh::BoundarySegment;
using mesh::TriangleMesh;
using SegmentOut = std::tuple<std::string, ArrayOut<std::int32_t>, std::optional<std::int32_t>>;
using SegmentIn = std::tuple<nb::object, IndicesIn, std::optional<std::int32_t>>;

std::vector<SegmentOut> segments_out(const TriangleMesh& mesh) {
  std::vector<SegmentOut> segments;
  for (const BoundarySegment& segment : mesh.boundary) {
    segments.emplace_back(std::string(name_of(segment.kind)),
                          indices_out(std::vector<Index>(segment.nodes)), segment.type);
  }
  return segments;
}

void set_segments(TriangleMesh& mesh, const std::vector<SegmentIn>& segments) {
  mesh.boundary.clear();
  for (const auto& [kind, nodes, type] : segments) {
    mesh.boundary.push_back(
        {named<mesh::BoundaryKind>("kind", kind), vector_of<Index>(nodes), type});
  }
}

// Throws InvalidInput (the position of the pair) for a coast that is not an edge of one triangle only.
void require_border(std::span<const Triple> triangles,
                    std::span<const std::array<Index, 2>> coast) {
  std::vector<std::array<Index, 2>> edges;
  for (const auto& [a, b, c] : triangles) edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
  std::ranges::sort(edges);
  const auto has = [&](Index a, Index b) {
    return std::ranges::binary_search(edges, std::array<Index, 2>{a, b});
  };
  for (std::size_t i = 0; i < coast.size(); ++i) {
    const auto& [a, b] = coast[i];
    if (has(a, b) != has(b, a)) continue;
    throw InvalidInput(
        "coast " + std::to_string(i) + " joins the nodes " + std::to_string(a) + " and " +
            std::to_string(b) +
            (has(a, b) ? ", which is an edge of two triangles: it is not on the border"
                       : ", which is not an edge of a triangle"),
        i);
  }
}

// Makes a mesh. Positions are degrees; where there are some, they give the points.
TriangleMesh mesh_of_triangles(const PointsIn& points, const PairsIn& positions,
                               const TriplesIn& triangles, const std::optional<IndexPairsIn>& coast,
                               const NumbersIn& depths, const NumbersIn& levels) {
  std::vector<Point> from_degrees;
  std::span<const Point> nodes = points_of(points);
  const auto degrees = rows_of<LonLat>(positions);
  if (!degrees.empty()) nodes = from_degrees = unit_vectors(degrees);
  std::optional<std::span<const std::array<Index, 2>>> edges;
  if (coast) edges = rows_of<std::array<Index, 2>>(*coast);
  TriangleMesh mesh = mesh::triangle_mesh(nodes, degrees, rows_of<Triple>(triangles), edges);
  mesh.depths = vector_of<double>(depths);
  mesh.levels = vector_of<double>(levels);
  mesh::require_valid(mesh);
  if (edges) require_border(rows_of<Triple>(triangles), *edges);
  return mesh;
}

// Returns the triangles that leave_out_flat() keeps.
ArrayOut<std::int32_t> without_flat(const PairsIn& positions, const TriplesIn& triangles,
                                    const IndexPairsIn& constraints) {
  const auto given = rows_of<Triple>(triangles);
  std::vector<Triple> kept(given.begin(), given.end());
  mesh::leave_out_flat(rows_of<LonLat>(positions), kept,
                       rows_of<std::array<Index, 2>>(constraints));
  return to_array<std::int32_t>(std::move(kept));
}

FileName file_of(const std::string& path, const std::string& format) { return {path, format}; }

std::tuple<TriangleMesh, std::vector<std::string>> triangles_of_file(const std::string& path,
                                                                     const std::string& format,
                                                                     unsigned threads) {
  std::vector<std::string> remarks;
  TriangleMesh mesh = watched_quietly(many_sites, threads, [&](const Execution& execution) {
    return mesh::read_triangle_mesh(file_of(path, format), execution, &remarks);
  });
  return {std::move(mesh), std::move(remarks)};
}

// Returns what the file does not hold.
std::vector<std::string> write_triangle_file(const TriangleMesh& mesh, const std::string& path,
                                             const std::string& format, unsigned threads) {
  std::vector<std::string> remarks;
  run_watched(mesh.points.size(), threads, nb::none(), [&](const Execution& execution) {
    mesh::write_triangle_mesh(file_of(path, format), mesh, {}, execution, &remarks);
  });
  return remarks;
}

// Fills a domain with triangles; a null area is the sphere. Returns the mesh, the number of triangles
// that are not as wanted because doubles have no place, and the lines of which nothing is in the mesh.
std::tuple<TriangleMesh, std::size_t, std::vector<Index>> triangles_of_domain(
    const Geometries& coast, const Geometries* area, const Geometries& lines,
    const NumbersIn& spacings, std::size_t steps, double gradient,
    const std::optional<double>& tolerance, const std::optional<double>& weld,
    double smallest_angle, double fill_narrow, double smallest_part, double west_deg,
    unsigned threads, const nb::object& listener) {
  mesh::TrianglesOptions options;
  options.refine.smallest_angle_deg = smallest_angle;
  options.fill_narrow = fill_narrow;
  options.smallest_part = smallest_part;
  options.tolerance = tolerance;
  options.weld = weld;
  mesh::MeshDomain domain;
  domain.west_deg = west_deg;
  if (coast.size() > 0) domain.coast.push_back(coast);
  if (area != nullptr) domain.area.push_back(*area);
  if (lines.size() > 0) domain.lines.push_back(lines);
  options.refine.spacing = size_of(rows_of<double>(spacings), raster_of(domain, steps), gradient);
  return watched(many_sites, threads, listener, [&](const Execution& execution) {
    const mesh::DomainTriangles made = mesh::triangles(domain, options, execution);
    return std::tuple(mesh::triangle_mesh(made), made.mesh.report.num_too_small,
                      made.lines_outside);
  });
}

// Returns the places where the spacing of a mesh is looked at; a null area is the sphere.
ArrayOut<double> raster_places(std::size_t steps, const Geometries* area) {
  mesh::MeshDomain domain;
  if (area != nullptr) domain.area.push_back(*area);
  return points_out(mesh::SizeFunction::nodes(raster_of(domain, steps)));
}

}  // namespace

void add_triangle_meshes(nb::module_& module) {
  nb::class_<TriangleMesh> type(module, "TriangleMesh");
  type.def(nb::init<>());
  add_array<double, &TriangleMesh::points>(type, "points");
  add_array<double, &TriangleMesh::positions>(type, "positions");
  add_array<std::int32_t, &TriangleMesh::triangles>(type, "triangles");
  add_array<double, &TriangleMesh::depths>(type, "depths");
  add_array<double, &TriangleMesh::levels>(type, "levels");
  type.def_prop_rw("boundary", &segments_out, &set_segments, nb::for_getter(nb::rv_policy::move));
  type.def("pinched_nodes",
           [](const TriangleMesh& mesh) { return indices_out(mesh::pinched_nodes(mesh)); });
  type.def("quality", [](const TriangleMesh& mesh) {
    const mesh::TriangleQuality quality = mesh::triangle_quality(mesh);
    return std::tuple(quality.smallest_angle_deg, quality.shortest_edge, quality.longest_edge);
  });
  type.def(
      "quality_picture",
      [](const TriangleMesh& mesh, std::size_t num_worst) {
        return unlocked([&] { return mesh::quality_picture(mesh, num_worst); });
      },
      nb::arg("num_worst"));
  type.def("write", &write_triangle_file, nb::arg("path"), nb::arg("format"), nb::arg("threads"));
  module.def("mesh_of_triangles", &mesh_of_triangles, nb::arg("points").noconvert(),
             nb::arg("positions").noconvert(), nb::arg("triangles").noconvert(),
             nb::arg("coast").noconvert().none(), nb::arg("depths").noconvert(),
             nb::arg("levels").noconvert());
  module.def("without_flat", &without_flat, nb::arg("positions").noconvert(),
             nb::arg("triangles").noconvert(), nb::arg("constraints").noconvert());
  module.def("triangles_of_domain", &triangles_of_domain, nb::arg("coast"), nb::arg("area").none(),
             nb::arg("lines"), nb::arg("spacings").noconvert(), nb::arg("steps"),
             nb::arg("gradient"), nb::arg("tolerance").none(), nb::arg("weld").none(),
             nb::arg("smallest_angle"), nb::arg("fill_narrow"), nb::arg("smallest_part"),
             nb::arg("west_deg"), nb::arg("threads"), nb::arg("progress").none());
  module.def("raster_places", &raster_places, nb::arg("steps"), nb::arg("area").none());
  module.def("read_triangles", &triangles_of_file, nb::arg("path"), nb::arg("format"),
             nb::arg("threads"));
}

}  // namespace rondel::python
