// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/mesh.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.h"
#include "interrupt.h"
#include "module.h"
#include "named.h"
#include "rondel/mesh_formats.h"
#include "rondel/mesh_quality.h"

namespace rondel::python {
namespace {

using mesh::VoronoiMesh;
using WeightsOfEdges = std::tuple<ArrayOut<std::int64_t>, ArrayOut<std::int32_t>, ArrayOut<double>>;

VoronoiMesh mesh_of(const Triangulation& t, double radius, const NumbersIn& density,
                    bool allow_zero_edges, unsigned threads, const nb::object& listener) {
  const mesh::MeshOptions options{
      .radius = radius, .density = rows_of<double>(density), .allow_zero_edges = allow_zero_edges};
  return watched(t.num_sites(), threads, listener, [&](const Execution& execution) {
    return mesh::make_mesh(t, options, execution);
  });
}

// Returns the mesh and the remarks of the reader.
std::tuple<VoronoiMesh, std::vector<std::string>> mesh_of_file(const std::string& path,
                                                               double radius, bool allow_zero_edges,
                                                               unsigned threads) {
  constexpr std::size_t many = 1U << 20U;
  std::vector<std::string> remarks;
  VoronoiMesh arrays = watched_quietly(many, threads, [&](const Execution& execution) {
    return mesh::read_mesh(path, {.radius = radius, .allow_zero_edges = allow_zero_edges},
                           execution, &remarks);
  });
  return {std::move(arrays), std::move(remarks)};
}

// Writes the mesh and, if a path for it is given, the graph: both files appear, or none does.
void write_mesh(const VoronoiMesh& arrays, const std::string& path, nb::handle format,
                nb::handle kind, const std::optional<std::string>& graph, unsigned threads) {
  const auto named_format = named<mesh::MeshFormat>("format", format);
  const auto named_kind = named<NetcdfKind>("kind", kind);
  run_watched(arrays.num_cells(), threads, nb::none(), [&](const Execution& execution) {
    FilesTogether files;
    mesh::write(path, arrays, {named_format, named_kind}, execution);
    if (graph) mesh::write_graph(*graph, arrays, execution);
    files.commit();
  });
}

// Returns the variables of a file of MPAS as a dictionary of pairs of dimensions and values, and
// its attributes.
std::tuple<nb::dict, nb::dict> mpas_content_of(const VoronoiMesh& arrays) {
  mesh::MpasContent content = watched_quietly(
      arrays.num_cells(), 0,
      [&](const Execution& execution) { return mesh::mpas_content(arrays, execution); });
  nb::dict variables;
  for (mesh::FileVariable& variable : content.variables) {
    const std::vector<std::size_t> shape(variable.shape.begin(), variable.shape.end());
    variables[variable.name.c_str()] = std::visit(
        [&]<class T>(std::vector<T>& values) {
          return nb::make_tuple(
              nb::tuple(nb::cast(variable.dimensions)),
              nb::cast(to_array<T>(std::move(values))).attr("reshape")(nb::cast(shape)));
        },
        variable.values);
  }
  nb::dict attributes;
  for (const auto& [name, value] : content.attributes) attributes[name.c_str()] = nb::cast(value);
  return {variables, attributes};
}

WeightsOfEdges weights_of_edges(const VoronoiMesh& arrays, unsigned threads) {
  mesh::TangentialWeights found = watched_quietly(
      arrays.num_cells(), threads,
      [&](const Execution& execution) { return mesh::tangential_weights(arrays, execution); });
  return {offsets_out(std::move(found.edges.offsets)), indices_out(std::move(found.edges.values)),
          to_array<double>(std::move(found.weights))};
}

// Adds the functions that make a mesh, of a triangulation or of a file.
void add_makers(nb::module_& module) {
  module.def("mesh_of", &mesh_of, nb::arg("triangulation"), nb::arg("radius"),
             nb::arg("density").noconvert(), nb::arg("allow_zero_edges"), nb::arg("threads"),
             nb::arg("listener").none());
  module.def("read_mesh", &mesh_of_file, nb::arg("path"), nb::arg("radius"),
             nb::arg("allow_zero_edges"), nb::arg("threads"));
}

}  // namespace

void add_mesh(nb::module_& module) {
  nb::class_<VoronoiMesh> type(module, "VoronoiMesh");
  type.def(nb::init<>());
  type.def_rw("radius", &VoronoiMesh::radius);
  add_array<double, &VoronoiMesh::cell_points>(type, "cell_points");
  add_array<double, &VoronoiMesh::cell_areas>(type, "cell_areas");
  add_array<double, &VoronoiMesh::density>(type, "density");
  add_array<std::int64_t, &VoronoiMesh::edges_on_cell, &CompressedRows<Index>::offsets>(type,
                                                                                        "offsets");
  add_array<std::int32_t, &VoronoiMesh::edges_on_cell, &CompressedRows<Index>::values>(
      type, "edges_on_cell");
  add_array<std::int32_t, &VoronoiMesh::cells_on_cell>(type, "cells_on_cell");
  add_array<std::int32_t, &VoronoiMesh::vertices_on_cell>(type, "vertices_on_cell");
  add_array<double, &VoronoiMesh::edge_points>(type, "edge_points");
  add_array<std::int32_t, &VoronoiMesh::cells_on_edge>(type, "cells_on_edge");
  add_array<std::int32_t, &VoronoiMesh::vertices_on_edge>(type, "vertices_on_edge");
  add_array<double, &VoronoiMesh::cell_distances>(type, "cell_distances");
  add_array<double, &VoronoiMesh::vertex_distances>(type, "vertex_distances");
  add_array<double, &VoronoiMesh::normal_angles>(type, "normal_angles");
  add_array<double, &VoronoiMesh::vertex_points>(type, "vertex_points");
  add_array<std::int32_t, &VoronoiMesh::cells_on_vertex>(type, "cells_on_vertex");
  add_array<std::int32_t, &VoronoiMesh::edges_on_vertex>(type, "edges_on_vertex");
  add_array<double, &VoronoiMesh::kite_areas>(type, "kite_areas");
  add_array<double, &VoronoiMesh::triangle_areas>(type, "triangle_areas");
  type.def("tangential_weights", &weights_of_edges, nb::arg("threads"));
  type.def("mpas_content", &mpas_content_of);
  type.def("write", &write_mesh, nb::arg("path"), nb::arg("format").none(), nb::arg("kind"),
           nb::arg("graph").none(), nb::arg("threads"));
  type.def(
      "quality_json",
      [](const VoronoiMesh& self, unsigned threads) {
        return mesh::quality_json(watched_quietly(
            self.num_cells(), threads,
            [&](const Execution& execution) { return mesh::quality(self, execution); }));
      },
      nb::arg("threads"));
  type.def(
      "cell_quality",
      [](const VoronoiMesh& self, unsigned threads) {
        mesh::CellQuality cells = watched_quietly(
            self.num_cells(), threads,
            [&](const Execution& execution) { return mesh::cell_quality(self, execution); });
        return std::tuple(to_array<double>(std::move(cells.centroid_offset)),
                          to_array<double>(std::move(cells.edge_ratio)),
                          to_array<double>(std::move(cells.side_ratio)),
                          to_array<double>(std::move(cells.distance_ratio)),
                          to_array<double>(std::move(cells.gradient)));
      },
      nb::arg("threads"));
  type.def(
      "quality_picture",
      [](const VoronoiMesh& self, std::size_t num_worst) {
        return unlocked(
            [&] { return mesh::quality_picture(self, mesh::quality(self), num_worst); });
      },
      nb::arg("num_worst"));
  add_makers(module);
}

}  // namespace rondel::python
