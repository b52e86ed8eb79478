// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// UGRID: meshes of faces, edges and nodes (UGRID conventions 1.0,
// https://ugrid-conventions.github.io/ugrid-conventions). A variable with the cf_role
// `mesh_topology` names all others: `node_coordinates`, `face_coordinates` and
// `face_node_connectivity` are read, and those of edges are written, too. Files that are written
// count from 0.
#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "exact/vector.h"
#include "formats/cf_names.h"
#include "formats/mesh_file.h"
#include "formats/netcdf_cells.h"
#include "io/bad_value.h"
#include "io/number.h"
#include "meshing/consistency.h"
#include "rondel/delaunay.h"

namespace rondel::formats {
namespace {

using io::BadValue;
using io::NetcdfReader;

// Returns the longitudes and latitudes among the variables that an attribute names: those that say
// what they are, or else the first two. Returns null pointers if it names fewer than two; throws
// BadValue if the file lacks one that it names.
MeshCoordinates coordinates_named_by(const NetcdfReader& file, const io::VariableInFile& of,
                                     const char* attribute) {
  const std::vector<std::string> names = words_of(io::netcdf_text(of.attributes, attribute));
  if (names.size() < 2) return {};
  const io::VariableInFile* lon = nullptr;
  const io::VariableInFile* lat = nullptr;
  for (const std::string& name : names) {
    const io::VariableInFile& variable = file.require(name);
    const VariableHeader header = header_of(file, variable);
    if (lon == nullptr && coordinate_evidence(header, CoordinateKind::lon) > 0) lon = &variable;
    if (lat == nullptr && coordinate_evidence(header, CoordinateKind::lat) > 0) lat = &variable;
  }
  const io::VariableInFile& first = file.require(names[0]);
  const io::VariableInFile& second = file.require(names[1]);
  if (lon == nullptr) lon = lat == &first ? &second : &first;
  if (lat == nullptr) lat = lon == &second ? &first : &second;
  return {lon, lat};
}

// Returns the topology of faces that `name` names or that the variable `name` is on, or the first
// one for an empty name; null if there is none. Adds a remark if there are others.
const io::VariableInFile* topology_of(const NetcdfReader& file, const std::string& name,
                                      MeshContent& mesh) {
  const io::VariableInFile* const named = file.find(name);
  const std::string mesh_of_named =
      named == nullptr ? std::string() : io::netcdf_text(named->attributes, "mesh");
  const io::VariableInFile* found = nullptr;
  std::string others;
  for (const io::VariableInFile& variable : file.variables()) {
    const bool is_topology =
        (io::netcdf_text(variable.attributes, "cf_role") == "mesh_topology" ||
         io::netcdf_text(variable.attributes, "standard_name") == "mesh_topology") &&
        number_or(variable, "topology_dimension", 2) == 2;
    if (!is_topology) continue;
    const io::VariableInFile* const faces =
        file.find(io::netcdf_text(variable.attributes, "face_node_connectivity"));
    const bool is_wanted =
        variable.name == name || variable.name == mesh_of_named ||
        (mesh_of_named.empty() && faces != nullptr && is_meant(file, name, *faces));
    if (!name.empty() && !is_wanted) continue;
    if (found == nullptr) {
      found = &variable;
    } else {
      others += ", " + variable.name;
    }
  }
  if (!others.empty()) {
    mesh.remarks.push_back("the file has several meshes: " + found->name + others +
                           "; the first one is read, and FILE.nc:NAME names another one");
  }
  return found;
}

// Throws BadValue for a variable on nodes or edges of the mesh.
void require_on_faces(const NetcdfReader& file, const io::VariableInFile& topology,
                      const std::string& name) {
  const io::VariableInFile* const named = file.find(name);
  const io::VariableInFile* const faces =
      file.find(io::netcdf_text(topology.attributes, "face_node_connectivity"));
  if (named == nullptr || faces == nullptr || named->shape.empty() || is_meant(file, name, *faces))
    return;
  const std::string location = io::netcdf_text(named->attributes, "location");
  throw BadValue("variable " + io::in_quotes(name) + " is at the " +
                 (location.empty() ? "nodes or edge" : location) + "s of mesh " +
                 io::in_quotes(topology.name) + ", which are no cells");
}

constexpr std::int32_t ugrid_none = -1;  // stands for no_index in 32 bits

// Defines longitudes and latitudes in degrees of nodes, edges or faces.
void define_places(MeshFile& file, const char* lon, const char* lat, std::size_t dimension,
                   const std::vector<Point>& points) {
  file.numbers(lon, dimension, texts_of_longitudes, points.size(),
               [&points](std::size_t i) { return longitude_deg_of(points[i]); });
  file.numbers(lat, dimension, texts_of_latitudes, points.size(),
               [&points](std::size_t i) { return latitude_deg_of(points[i]); });
}

// Writes the entries of a ring for each of its edges that has a length, then fills the row. The
// edges of a cell are counterclockwise from the one that ends at its first corner.
template <class Entry>
void define_face_list(MeshFile& file, io::NetcdfVariable variable, const CellCorners& corners,
                      std::size_t room, Entry entry) {
  const mesh::VoronoiMesh& arrays = file.arrays();
  file.add<std::int32_t>(std::move(variable), arrays.num_cells(), room,
                         [&arrays, &corners, room, entry](std::size_t cell, std::int32_t* out) {
                           std::fill_n(out, room, ugrid_none);
                           entry(arrays, corners, cell, out);
                         });
}

// Writes the corners of a cell to `out`: `face_node_connectivity`.
void face_nodes(const mesh::VoronoiMesh& /*arrays*/, const CellCorners& corners, std::size_t cell,
                std::int32_t* out) {
  corners.visit(cell, [&](Index corner) { *out++ = static_cast<std::int32_t>(corner); });
}

// Writes the edges of a cell that have a length: `face_edge_connectivity`.
void face_edges(const mesh::VoronoiMesh& arrays, const CellCorners& /*corners*/, std::size_t cell,
                std::int32_t* out) {
  for (std::uint64_t at = arrays.edges_on_cell.offsets[cell];
       at < arrays.edges_on_cell.offsets[cell + 1]; ++at) {
    const Index e = arrays.edges_on_cell.values[at];
    if (arrays.vertex_distances[e] > 0) *out++ = static_cast<std::int32_t>(e);
  }
}

// Writes the neighbors of a cell across these edges: `face_face_connectivity`. At a border,
// no_index becomes -1.
void face_faces(const mesh::VoronoiMesh& arrays, const CellCorners& /*corners*/, std::size_t cell,
                std::int32_t* out) {
  for (std::uint64_t at = arrays.edges_on_cell.offsets[cell];
       at < arrays.edges_on_cell.offsets[cell + 1]; ++at) {
    if (arrays.vertex_distances[arrays.edges_on_cell.values[at]] > 0) {
      *out++ = static_cast<std::int32_t>(arrays.cells_on_cell[at]);
    }
  }
}

// Writes two indices for each edge: `edge_node_connectivity` or `edge_face_connectivity`.
template <class Row>
void define_pairs(MeshFile& file, io::NetcdfVariable variable, const std::vector<Row>& rows) {
  file.add<std::int32_t>(std::move(variable), rows.size(), 2,
                         [&rows](std::size_t e, std::int32_t* out) {
                           out[0] = static_cast<std::int32_t>(rows[e][0]);
                           out[1] = static_cast<std::int32_t>(rows[e][1]);
                         });
}

}  // namespace

io::NetcdfVariable ugrid_indices(const char* name, const char* role,
                                 std::vector<std::size_t> dimensions, bool is_filled) {
  auto variable =
      MeshFile::variable(name, io::NetcdfType::int32, std::move(dimensions), {{"cf_role", role}});
  MeshFile::set(variable, "start_index", 0);
  if (is_filled) MeshFile::set(variable, "_FillValue", ugrid_none);
  return variable;
}

std::optional<MeshContent> read_ugrid(const NetcdfReader& file, const std::string& name) {
  MeshContent mesh;
  const io::VariableInFile* const topology = topology_of(file, name, mesh);
  if (topology == nullptr) return std::nullopt;
  require_on_faces(file, *topology, name);
  const MeshCoordinates nodes = coordinates_named_by(file, *topology, "node_coordinates");
  const MeshCoordinates centers = coordinates_named_by(file, *topology, "face_coordinates");
  if (nodes.lon == nullptr) {
    throw BadValue("variable " + io::in_quotes(topology->name) + " names no node_coordinates");
  }
  mesh.convention = "UGRID";
  take_nodes(file, nodes, centers, UsualUnits::degrees, mesh);
  const io::VariableInFile& faces = require_rank(
      file.require(io::netcdf_text(topology->attributes, "face_node_connectivity")), 2);
  // UGRID has the faces first, unless `face_dimension`, or the dimension of the centers, says that
  // they are the last dimension.
  std::string dimension = io::netcdf_text(topology->attributes, "face_dimension");
  if (dimension.empty() && centers.lon != nullptr && centers.lon->dimensions.size() == 1) {
    dimension = file.dimensions()[centers.lon->dimensions[0]].name;
  }
  const bool is_transposed = !dimension.empty() &&
                             file.dimensions()[faces.dimensions[1]].name == dimension &&
                             file.dimensions()[faces.dimensions[0]].name != dimension;
  const std::uint64_t num_cells = faces.shape[is_transposed ? 1 : 0];
  const std::uint64_t corners_per_cell = faces.shape[is_transposed ? 0 : 1];
  constexpr std::uint64_t few = 4;     // corners of most faces
  constexpr std::uint64_t many = 256;  // corners of hardly any
  if (num_cells <= few && corners_per_cell > many) {
    throw BadValue(
        "variable " + io::in_quotes(faces.name) + " has " + std::to_string(num_cells) +
        " faces of " + std::to_string(corners_per_cell) +
        " corners; if its last dimension counts faces, the attribute face_dimension of " +
        io::in_quotes(topology->name) + " must say so");
  }
  const double first = number_or(faces, "start_index", 0);
  take_connectivity(file, {faces, num_cells, corners_per_cell, is_transposed, first, first}, {},
                    mesh);
  take_centers(file, centers, nodes, UsualUnits::degrees, mesh);
  return mesh;
}

std::vector<LonLat> middles_of_edges(const NetcdfReader& file, const std::string& name) {
  const io::VariableInFile* const values = file.find(name);
  if (values == nullptr || io::netcdf_text(values->attributes, "location") != "edge") return {};
  const io::VariableInFile* const topology = file.find(io::netcdf_text(values->attributes, "mesh"));
  if (topology == nullptr ||
      coordinates_named_by(file, *topology, "edge_coordinates").lon != nullptr) {
    return {};
  }
  const io::VariableInFile* const edges =
      file.find(io::netcdf_text(topology->attributes, "edge_node_connectivity"));
  const MeshCoordinates coordinates = coordinates_named_by(file, *topology, "node_coordinates");
  if (edges == nullptr || coordinates.lon == nullptr) return {};
  const std::vector<LonLat> nodes = positions_of(file, coordinates, {}, UsualUnits::degrees);
  const std::vector<double> ends = file.numbers(require_rank(*edges, 2));
  const bool is_transposed = edges->shape[0] == 2 && edges->shape[1] != 2;
  const std::size_t num_edges = ends.size() / 2;
  const double first = number_or(*edges, "start_index", 0);
  std::vector<Point> middles;
  for (std::size_t e = 0; e < num_edges; ++e) {
    Point sum{0, 0, 0};
    for (std::size_t k = 0; k < 2; ++k) {
      const double node = ends[is_transposed ? k * num_edges + e : 2 * e + k] - first;
      if (!(node >= 0 && node < static_cast<double>(nodes.size()))) {
        throw BadValue("edge " + std::to_string(e) + " has an end in " +
                       io::in_quotes(edges->name) + " that is none of " +
                       std::to_string(nodes.size()) + " nodes");
      }
      const auto number = static_cast<std::size_t>(node);
      sum = sum + unit_vector(require_position("the nodes of edges", number, nodes[number]));
    }
    middles.push_back(normalized(sum));
  }
  return lonlats(middles);
}

// The variable `mesh` has no value of its own; its attributes name the other variables.
void define_ugrid(MeshFile& file, const CellCorners& corners) {
  const mesh::VoronoiMesh& arrays = file.arrays();
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
  // The topology is a variable without dimensions, whose value is 0.
  file.add<std::int32_t>(std::move(topology), 1, 1, [](std::size_t, std::int32_t*) {});
  define_places(file, "node_lon", "node_lat", nodes, arrays.vertex_points);
  define_places(file, "edge_lon", "edge_lat", edges, arrays.edge_points);
  define_places(file, "face_lon", "face_lat", faces, arrays.cell_points);
  define_face_list(file,
                   ugrid_indices("face_nodes", "face_node_connectivity", {faces, max_nodes}, true),
                   corners, room, face_nodes);
  define_pairs(file, ugrid_indices("edge_nodes", "edge_node_connectivity", {edges, two}, false),
               arrays.vertices_on_edge);
  define_face_list(file,
                   ugrid_indices("face_edges", "face_edge_connectivity", {faces, max_nodes}, true),
                   corners, room, face_edges);
  define_face_list(file,
                   ugrid_indices("face_faces", "face_face_connectivity", {faces, max_nodes}, true),
                   corners, room, face_faces);
  define_pairs(file,
               ugrid_indices("edge_faces", "edge_face_connectivity", {edges, two},
                             meshing::has_border(arrays)),
               arrays.cells_on_edge);
}

}  // namespace rondel::formats
