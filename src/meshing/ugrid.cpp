// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes UGRID conventions 1.0 (https://ugrid-conventions.github.io/ugrid-conventions). Numbers
// start at 0.

#include <algorithm>

#include "meshing/mesh_file.h"

namespace rondel::meshing {
namespace {

constexpr std::int32_t ugrid_none = -1;  // stands for no_index in 32 bits

using UgridTexts = MeshFile::Texts;
constexpr UgridTexts east = {{"units", "degrees_east"}, {"standard_name", "longitude"}};
constexpr UgridTexts north = {{"units", "degrees_north"}, {"standard_name", "latitude"}};

// Defines longitudes and latitudes in degrees.
void define_places(MeshFile& file, const char* lon, const char* lat, std::size_t dimension,
                   const std::vector<Point>& points) {
  file.numbers(lon, dimension, east, points.size(),
               [&points](std::size_t i) { return longitude_deg_of(points[i]); });
  file.numbers(lat, dimension, north, points.size(),
               [&points](std::size_t i) { return latitude_deg_of(points[i]); });
}

// Returns a variable of indices. If `is_filled`, -1 stands for none.
io::NetcdfVariable connectivity(const char* name, const char* role,
                                std::vector<std::size_t> dimensions, bool is_filled) {
  auto variable =
      MeshFile::variable(name, io::NetcdfType::int32, std::move(dimensions), {{"cf_role", role}});
  MeshFile::set(variable, "start_index", 0);
  if (is_filled) MeshFile::set(variable, "_FillValue", ugrid_none);
  return variable;
}

// Writes the entries of a ring for each of its edges that has a length, then fills the row. The
// edges of a cell are counterclockwise from the one that ends at its first corner.
template <class Entry>
void define_face_list(MeshFile& file, io::NetcdfVariable variable, const CellCorners& corners,
                      std::size_t room, Entry entry) {
  const mesh::MeshArrays& arrays = file.arrays();
  file.add<std::int32_t>(std::move(variable), arrays.num_cells(), room,
                         [&arrays, &corners, room, entry](std::size_t cell, std::int32_t* out) {
                           std::fill_n(out, room, ugrid_none);
                           entry(arrays, corners, cell, out);
                         });
}

void face_nodes(const mesh::MeshArrays& /*arrays*/, const CellCorners& corners, std::size_t cell,
                std::int32_t* out) {
  corners.visit(cell, [&](Index corner) { *out++ = static_cast<std::int32_t>(corner); });
}

void face_edges(const mesh::MeshArrays& arrays, const CellCorners& /*corners*/, std::size_t cell,
                std::int32_t* out) {
  for (std::uint64_t at = arrays.offsets[cell]; at < arrays.offsets[cell + 1]; ++at) {
    const Index e = arrays.edges_on_cell[at];
    if (arrays.vertex_distances[e] > 0) *out++ = static_cast<std::int32_t>(e);
  }
}

void face_faces(const mesh::MeshArrays& arrays, const CellCorners& /*corners*/, std::size_t cell,
                std::int32_t* out) {
  for (std::uint64_t at = arrays.offsets[cell]; at < arrays.offsets[cell + 1]; ++at) {
    if (arrays.vertex_distances[arrays.edges_on_cell[at]] > 0) {
      *out++ = static_cast<std::int32_t>(arrays.cells_on_cell[at]);
    }
  }
}

template <class Row>
void define_pairs(MeshFile& file, io::NetcdfVariable variable, const std::vector<Row>& rows) {
  file.add<std::int32_t>(std::move(variable), rows.size(), 2,
                         [&rows](std::size_t e, std::int32_t* out) {
                           out[0] = static_cast<std::int32_t>(rows[e][0]);
                           out[1] = static_cast<std::int32_t>(rows[e][1]);
                         });
}

}  // namespace

void define_ugrid(MeshFile& file, const CellCorners& corners) {
  const mesh::MeshArrays& arrays = file.arrays();
  const std::size_t room = arrays.max_edges();
  const std::size_t nodes = file.dimension("n_node", arrays.num_vertices());
  const std::size_t edges = file.dimension("n_edge", arrays.num_edges());
  const std::size_t faces = file.dimension("n_face", arrays.num_cells());
  const std::size_t max_nodes = file.dimension("n_max_face_nodes", room);
  const std::size_t two = file.dimension("two", 2);
  file.netcdf().add_attribute("Conventions", "CF-1.11 UGRID-1.0");
  file.netcdf().add_attribute("title", "Voronoi cells");
  auto topology =
      MeshFile::variable("mesh", io::NetcdfType::int32, {},
                         {{"cf_role", "mesh_topology"},
                          {"long_name", "Voronoi cells, the sites being face_coordinates"},
                          {"node_coordinates", "node_lon node_lat"},
                          {"edge_coordinates", "edge_lon edge_lat"},
                          {"face_coordinates", "face_lon face_lat"},
                          {"face_node_connectivity", "face_nodes"},
                          {"edge_node_connectivity", "edge_nodes"},
                          {"face_edge_connectivity", "face_edges"},
                          {"face_face_connectivity", "face_faces"},
                          {"edge_face_connectivity", "edge_faces"},
                          {"face_dimension", "n_face"},
                          {"edge_dimension", "n_edge"}});
  MeshFile::set(topology, "topology_dimension", 2);
  file.add<std::int32_t>(std::move(topology), 1, 1, [](std::size_t, std::int32_t*) {});
  define_places(file, "node_lon", "node_lat", nodes, arrays.vertex_points);
  define_places(file, "edge_lon", "edge_lat", edges, arrays.edge_points);
  define_places(file, "face_lon", "face_lat", faces, arrays.cell_points);
  define_face_list(file,
                   connectivity("face_nodes", "face_node_connectivity", {faces, max_nodes}, true),
                   corners, room, face_nodes);
  define_pairs(file, connectivity("edge_nodes", "edge_node_connectivity", {edges, two}, false),
               arrays.vertices_on_edge);
  define_face_list(file,
                   connectivity("face_edges", "face_edge_connectivity", {faces, max_nodes}, true),
                   corners, room, face_edges);
  define_face_list(file,
                   connectivity("face_faces", "face_face_connectivity", {faces, max_nodes}, true),
                   corners, room, face_faces);
  define_pairs(
      file, connectivity("edge_faces", "edge_face_connectivity", {edges, two}, has_border(arrays)),
      arrays.cells_on_edge);
}

}  // namespace rondel::meshing
