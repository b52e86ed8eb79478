// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Meshes of a part of the sphere, and rows of sites along lines.

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "arrays.h"
#include "file_name.h"
#include "interrupt.h"
#include "mesh_sizes.h"
#include "module.h"
#include "polygon_rules.h"
#include "rondel/cell_set.h"
#include "rondel/mesh_cull.h"
#include "rondel/mesh_lines.h"
#include "rondel/regions.h"

namespace rondel::python {
namespace {

using mesh::VoronoiMesh;
using CullOut =
    std::tuple<VoronoiMesh, ArrayOut<std::int32_t>, ArrayOut<std::int32_t>, ArrayOut<std::int32_t>>;
using MaskIn = nb::ndarray<const std::uint8_t, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

CullOut cull_mesh(const VoronoiMesh& arrays, const MaskIn& is_removed, unsigned threads) {
  mesh::Culled culled =
      watched_quietly(arrays.num_cells(), threads, [&](const Execution& execution) {
        return mesh::cull(arrays, rows_of<std::uint8_t>(is_removed), execution);
      });
  return {std::move(culled.arrays), indices_out(std::move(culled.cells)),
          indices_out(std::move(culled.edges)), indices_out(std::move(culled.vertices))};
}

ArrayOut<std::uint8_t> points_inside(const PointsIn& points, const CellSet& regions,
                                     unsigned threads) {
  return to_array<std::uint8_t>(
      watched_quietly(points.shape(0), threads, [&](const Execution& execution) {
        return mesh::inside(points_of(points), regions.rings(), execution);
      }));
}

// Returns sites on lines, or rows beside them, which `places` finds, for `count` cells with these
// spacings.
template <auto places>
std::tuple<ArrayOut<double>, std::size_t> sites_of_lines(const std::vector<PointsIn>& lines,
                                                         std::size_t count,
                                                         const NumbersIn& spacings,
                                                         std::size_t steps, double gradient,
                                                         unsigned threads) {
  std::vector<std::vector<Point>> all;
  for (const PointsIn& line : lines) {
    const std::span<const Point> points = points_of(line);
    all.emplace_back(points.begin(), points.end());
  }
  mesh::LineSites found = watched_quietly(many_sites, threads, [&](const Execution& execution) {
    return places(all, size_along(size_of(rows_of<double>(spacings), steps, gradient), count),
                  execution);
  });
  return {points_out(std::move(found.sites)), found.num_left_out};
}

// Returns cells as polygons of the plane.
LonLatRegions mesh_polygons(const VoronoiMesh& arrays, double tolerance_deg) {
  return watched_quietly(arrays.num_cells(), 0, [&](const Execution& execution) {
    CellRings rings;
    rings.points = arrays.vertex_points;
    for (Point& p : rings.points) {
      const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
      p = {p.x / length, p.y / length, p.z / length};
    }
    rings.corners = arrays.vertices_on_cell;
    rings.rings = arrays.edges_on_cell.offsets;
    rings.cells.resize(arrays.edges_on_cell.offsets.size());
    std::iota(rings.cells.begin(), rings.cells.end(), std::uint64_t{0});
    return region_polygons(rings, tolerance_deg, execution);
  });
}

// Returns the lines of a file; `read` is read_lines() or read_places().
template <auto read>
std::vector<ArrayOut<double>> lines_of_file(const PathIn& path, nb::handle edges,
                                            unsigned threads) {
  const PolygonOptions options = polygon_rules(edges);
  std::vector<std::vector<Point>> found = read_from(path, [&](const FileName& file) {
    return watched_quietly(
        0, threads, [&](const Execution& execution) { return read(file, options, execution); });
  });
  std::vector<ArrayOut<double>> lines;
  lines.reserve(found.size());
  for (std::vector<Point>& line : found) lines.push_back(points_out(std::move(line)));
  return lines;
}

}  // namespace

void add_mesh_parts(nb::module_& module) {
  module.def("cull_mesh", &cull_mesh, nb::arg("arrays"), nb::arg("is_removed").noconvert(),
             nb::arg("threads"));
  module.def("points_inside", &points_inside, nb::arg("points").noconvert(), nb::arg("regions"),
             nb::arg("threads"));
  const auto add_sites = [&](const char* name, auto* function) {
    module.def(name, function, nb::arg("lines"), nb::arg("count"), nb::arg("spacings").noconvert(),
               nb::arg("steps"), nb::arg("gradient"), nb::arg("threads"));
  };
  add_sites("sites_on", &sites_of_lines<mesh::sites_on>);
  add_sites("sites_along", &sites_of_lines<mesh::sites_along>);
  module.def("mesh_polygons", &mesh_polygons, nb::arg("arrays"), nb::arg("tolerance_deg"));
  const auto add_reader = [&](const char* name, auto* function) {
    module.def(name, function, nb::arg("path"), nb::arg("edges").none(), nb::arg("threads"));
  };
  add_reader("read_lines", &lines_of_file<mesh::read_lines>);
  add_reader("read_places", &lines_of_file<mesh::read_places>);
}

}  // namespace rondel::python
