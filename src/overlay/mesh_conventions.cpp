// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Readers of unstructured meshes of netCDF files:
//
// 1. UGRID: https://ugrid-conventions.github.io/ugrid-conventions
// 2. SCRIP's grids: Jones, SCRIP user's guide, 1998, section 2.2.1
// 3. ESMF's unstructured grids: ESMF reference manual, section 12.8.2 ("ESMF Unstructured Grid File
//    Format")
// 4. MPAS: Mesh Specification, https://mpas-dev.github.io/files/documents/MPAS-MeshSpec.pdf
// 5. ICON: grid files of the ICON grid generator
#include <algorithm>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "io/bad_value.h"
#include "io/cf_names.h"
#include "io/mpas_places.h"
#include "io/number.h"
#include "overlay/mesh_formats.h"

namespace rondel::overlay {
namespace {

using io::BadValue;
using io::NetcdfReader;

// Returns the words of a text that spaces separate.
std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// Returns the longitudes and latitudes among the variables that an attribute names: those that say
// what they are, or else the first two.
MeshCoordinates coordinates_of(const NetcdfReader& file, const MeshVariable& of,
                               const char* attribute) {
  const std::vector<std::string> names = words_of(io::netcdf_text(of.attributes, attribute));
  if (names.size() < 2) return {};
  const MeshVariable* lon = nullptr;
  const MeshVariable* lat = nullptr;
  for (const std::string& name : names) {
    const MeshVariable& variable = file.require(name);
    const VariableHeader header = io::header_of(file, variable);
    if (lon == nullptr && io::coordinate_evidence(header, io::CoordinateKind::lon) > 0)
      lon = &variable;
    if (lat == nullptr && io::coordinate_evidence(header, io::CoordinateKind::lat) > 0)
      lat = &variable;
  }
  const MeshVariable& first = file.require(names[0]);
  const MeshVariable& second = file.require(names[1]);
  if (lon == nullptr) lon = lat == &first ? &second : &first;
  if (lat == nullptr) lat = lon == &second ? &first : &second;
  return {lon, lat};
}

// Returns the places of one variable with both coordinates of each place, as ESMF has them.
std::vector<LonLat> pairs_of(const NetcdfReader& file, const MeshVariable& variable,
                             const MeshVariable* related) {
  if (require_rank(variable, 2).shape[1] != 2) {
    throw BadValue("variable " + io::in_quotes(variable.name) + " has " +
                   std::to_string(variable.shape[1]) + " coordinates instead of 2");
  }
  const std::vector<double> values = io::degrees_of(file, variable, UsualUnits::degrees, {related});
  std::vector<LonLat> places;
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    places.push_back({values[i], values[i + 1]});
  }
  return places;
}

// Returns the topology of faces that `name` names or that the variable `name` is on, or the first
// one for an empty name; null if there is none.
const MeshVariable* topology_of(const NetcdfReader& file, const std::string& name,
                                MeshContent& mesh) {
  const MeshVariable* const named = file.find(name);
  const std::string mesh_of_named =
      named == nullptr ? std::string() : io::netcdf_text(named->attributes, "mesh");
  const MeshVariable* found = nullptr;
  std::string others;
  for (const MeshVariable& variable : file.variables()) {
    const bool is_topology =
        (io::netcdf_text(variable.attributes, "cf_role") == "mesh_topology" ||
         io::netcdf_text(variable.attributes, "standard_name") == "mesh_topology") &&
        number_or(variable, "topology_dimension", 2) == 2;
    if (!is_topology) continue;
    const MeshVariable* const faces =
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
void require_on_faces(const NetcdfReader& file, const MeshVariable& topology,
                      const std::string& name) {
  const MeshVariable* const named = file.find(name);
  const MeshVariable* const faces =
      file.find(io::netcdf_text(topology.attributes, "face_node_connectivity"));
  if (named == nullptr || faces == nullptr || named->shape.empty() || is_meant(file, name, *faces))
    return;
  const std::string location = io::netcdf_text(named->attributes, "location");
  throw BadValue("variable " + io::in_quotes(name) + " is at the " +
                 (location.empty() ? "nodes or edge" : location) + "s of mesh " +
                 io::in_quotes(topology.name) + ", which are no cells");
}

}  // namespace

std::optional<MeshContent> read_ugrid(const NetcdfReader& file, const std::string& name) {
  MeshContent mesh;
  const MeshVariable* const topology = topology_of(file, name, mesh);
  if (topology == nullptr) return std::nullopt;
  require_on_faces(file, *topology, name);
  const MeshCoordinates nodes = coordinates_of(file, *topology, "node_coordinates");
  const MeshCoordinates centers = coordinates_of(file, *topology, "face_coordinates");
  if (nodes.lon == nullptr) {
    throw BadValue("variable " + io::in_quotes(topology->name) + " names no node_coordinates");
  }
  mesh.convention = "UGRID";
  take_nodes(file, nodes, centers, UsualUnits::degrees, mesh);
  const MeshVariable& faces = require_rank(
      file.require(io::netcdf_text(topology->attributes, "face_node_connectivity")), 2);
  const std::string dimension = io::netcdf_text(topology->attributes, "face_dimension");
  const bool is_transposed = !dimension.empty() &&
                             file.dimensions()[faces.dimensions[1]].name == dimension &&
                             file.dimensions()[faces.dimensions[0]].name != dimension;
  const std::uint64_t num_cells = faces.shape[is_transposed ? 1 : 0];
  const std::uint64_t of_each = faces.shape[is_transposed ? 0 : 1];
  const double first = number_or(faces, "start_index", 0);
  take_connectivity(file, {faces, num_cells, of_each, is_transposed, first, first}, {}, mesh);
  take_centers(file, centers, nodes, UsualUnits::degrees, mesh);
  return mesh;
}

std::optional<MeshContent> read_scrip_grid(const NetcdfReader& file, const std::string& name) {
  const MeshVariable* const lon = file.find("grid_corner_lon");
  const MeshVariable* const lat = file.find("grid_corner_lat");
  if (lon == nullptr || lat == nullptr || !is_meant(file, name, *lon)) return std::nullopt;
  MeshContent mesh;
  mesh.convention = "SCRIP";
  (void)require_rank(*lon, 2);
  const MeshCoordinates centers = {file.find("grid_center_lon"), file.find("grid_center_lat")};
  const bool is_transposed = centers.lon != nullptr && centers.lon->dimensions.size() == 1 &&
                             centers.lon->dimensions[0] == lon->dimensions[1] &&
                             centers.lon->dimensions[0] != lon->dimensions[0];
  const std::uint64_t num_cells = lon->shape[is_transposed ? 1 : 0];
  if (num_cells == 0 || lon->num_values >= no_index) {
    throw BadValue("variable " + io::in_quotes(lon->name) + " has " +
                   std::to_string(lon->num_values) + " values for " + std::to_string(num_cells) +
                   " cells");
  }
  take_nodes(file, {lon, lat}, centers, UsualUnits::degrees, mesh);
  const std::uint64_t of_each = lon->num_values / num_cells;
  if (is_transposed) {
    std::vector<LonLat> nodes;
    for (std::uint64_t i = 0; i < num_cells; ++i) {
      for (std::uint64_t k = 0; k < of_each; ++k) nodes.push_back(mesh.nodes[k * num_cells + i]);
    }
    mesh.nodes = std::move(nodes);
  }
  if (const MeshVariable* const dims = file.find("grid_dims")) {
    mesh.shape = io::shape_of_grid(file, *dims, num_cells);
  }
  end_cells_of_nodes(of_each, !has_rows(mesh.shape), mesh);
  take_mask(file, "grid_imask", num_cells, MaskedBy::zero, mesh);
  take_centers(file, centers, {lon, lat}, UsualUnits::degrees, mesh);
  return mesh;
}

std::optional<MeshContent> read_esmf_mesh(const NetcdfReader& file, const std::string& name) {
  const MeshVariable* const nodes = file.find("nodeCoords");
  const MeshVariable* const elements = file.find("elementConn");
  if (nodes == nullptr || elements == nullptr) return std::nullopt;
  const MeshVariable& numbers = file.require("numElementConn");
  if (!is_meant(file, name, numbers)) return std::nullopt;
  MeshContent mesh;
  mesh.convention = "ESMF";
  const MeshVariable* const centers = file.find("centerCoords");
  mesh.nodes = pairs_of(file, *nodes, centers);
  mesh.names = io::in_quotes(nodes->name);
  mesh.is_single = nodes->type == io::NetcdfType::float32;
  const std::vector<double> counts = file.numbers(numbers);
  const double first = number_or(*elements, "start_index", 1);
  const double no_break = first;
  const double break_value = number_or(*elements, "polybreak_value", no_break);
  take_mask(file, "elementMask", counts.size(), MaskedBy::zero, mesh);
  if (elements->shape.size() == 1) {
    // The rows have different lengths and follow each other.
    take_connectivity(file, {*elements, counts.size(), 0, false, first, break_value}, counts, mesh);
  } else {
    if (require_rank(*elements, 2).shape[0] != counts.size()) {
      throw BadValue("variable " + io::in_quotes(elements->name) + " has " +
                     std::to_string(elements->shape[0]) + " rows instead of " +
                     std::to_string(counts.size()));
    }
    take_connectivity(
        file, {*elements, elements->shape[0], elements->shape[1], false, first, break_value},
        counts, mesh);
  }
  if (centers != nullptr) {
    mesh.centers = pairs_of(file, *centers, nodes);
    mesh.center_names = io::in_quotes(centers->name);
    require_values(*centers, 2 * counts.size());
  }
  return mesh;
}

std::optional<MeshContent> read_mpas(const NetcdfReader& file, const std::string& name) {
  const MeshVariable* const vertices = file.find("verticesOnCell");
  if (vertices == nullptr || !is_meant(file, name, *vertices)) return std::nullopt;
  io::require_sphere(file);
  MeshContent mesh;
  mesh.convention = "MPAS";
  for (const char* kind : {"Cell", "Vertex"})
    io::require_one_place(file, kind, io::PlacesMay::be_missing);
  const MeshCoordinates nodes = {&file.require("lonVertex"), &file.require("latVertex")};
  const MeshCoordinates centers = {file.find("lonCell"), file.find("latCell")};
  take_nodes(file, nodes, centers, UsualUnits::radians, mesh);
  const std::vector<double> counts = file.numbers(file.require("nEdgesOnCell"));
  require_rank(*vertices, 2);
  if (counts.size() != vertices->shape[0]) {
    throw BadValue("variable " + io::in_quotes("nEdgesOnCell") + " has " +
                   std::to_string(counts.size()) + " values instead of " +
                   std::to_string(vertices->shape[0]));
  }
  take_connectivity(file, {*vertices, vertices->shape[0], vertices->shape[1], false, 1, 1}, counts,
                    mesh);
  take_centers(file, centers, nodes, UsualUnits::radians, mesh);
  return mesh;
}

std::optional<MeshContent> read_icon(const NetcdfReader& file, const std::string& name) {
  const MeshVariable* const vertices = file.find("vertex_of_cell");
  const MeshVariable* const lon = file.find("vlon");
  const MeshVariable* const lat = file.find("vlat");
  if (vertices == nullptr || lon == nullptr || lat == nullptr || !is_meant(file, name, *vertices)) {
    return std::nullopt;
  }
  MeshContent mesh;
  mesh.convention = "ICON";
  const MeshCoordinates centers = {file.find("clon"), file.find("clat")};
  take_nodes(file, {lon, lat}, centers, UsualUnits::radians, mesh);
  require_rank(*vertices, 2);
  take_connectivity(file, {*vertices, vertices->shape[1], vertices->shape[0], true, 1, 1}, {},
                    mesh);
  take_centers(file, centers, {lon, lat}, UsualUnits::radians, mesh);
  return mesh;
}

}  // namespace rondel::overlay
