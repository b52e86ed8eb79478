// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Unstructured mesh files of ESMF (ESMF reference manual, section 12.8.2, "ESMF Unstructured Grid
// File Format"). Weights of ESMF are in weights_esmf.cpp.
//
// `nodeCoords` and `centerCoords` have a longitude and a latitude in each row; `elementConn` has
// the nodes of each element, `numElementConn` how many of them there are; `elementMask` is 0 for an
// element that takes no part.
#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "formats/mesh_file.h"
#include "formats/netcdf_cells.h"
#include "io/bad_value.h"
#include "io/number.h"

namespace rondel::formats {
namespace {

using io::BadValue;
using io::NetcdfReader;

// The entry of `elementConn` behind the last node of an element.
constexpr std::int32_t esmf_none = -1;

// Returns the places of a variable of the shape (places, 2) in degrees; without units they are
// those of `related` (which may be null), or else degrees. Throws BadValue for another shape.
std::vector<LonLat> pairs_of(const NetcdfReader& file, const io::VariableInFile& variable,
                             const io::VariableInFile* related) {
  if (require_rank(variable, 2).shape[1] != 2) {
    throw BadValue("variable " + io::in_quotes(variable.name) + " has " +
                   std::to_string(variable.shape[1]) + " coordinates instead of 2");
  }
  const std::vector<double> values = degrees_of(file, variable, UsualUnits::degrees, {related});
  std::vector<LonLat> places;
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    places.push_back({values[i], values[i + 1]});
  }
  return places;
}

// Defines a variable of longitudes and latitudes in texts_of_degrees, a pair a row.
void define_pairs_of_degrees(MeshFile& file, const char* name, std::vector<std::size_t> dimensions,
                             const std::vector<Point>& points) {
  file.numbers(name, std::move(dimensions), texts_of_degrees, points.size(), 2,
               [&points](std::size_t i, double* out) {
                 out[0] = longitude_deg_of(points[i]);
                 out[1] = latitude_deg_of(points[i]);
               });
}

// Defines `numElementConn`. ESMF stores counts as bytes if these suffice.
template <typename T>
void define_counts(MeshFile& file, io::NetcdfType type, std::size_t cells,
                   const CellCorners& corners) {
  file.add<T>(MeshFile::variable("numElementConn", type, {cells},
                                 {{"long_name", "Number of nodes per element"}}),
              file.arrays().num_cells(), 1,
              [&corners](std::size_t cell, T* out) { *out = static_cast<T>(corners.count(cell)); });
}

}  // namespace

std::optional<MeshContent> read_esmf_mesh(const NetcdfReader& file, const std::string& name) {
  const io::VariableInFile* const nodes = file.find("nodeCoords");
  const io::VariableInFile* const elements = file.find("elementConn");
  if (nodes == nullptr || elements == nullptr) return std::nullopt;
  const io::VariableInFile& numbers = file.require("numElementConn");
  if (!is_meant(file, name, numbers)) return std::nullopt;
  MeshContent mesh;
  mesh.convention = "ESMF";
  const io::VariableInFile* const centers = file.find("centerCoords");
  mesh.nodes = pairs_of(file, *nodes, centers);
  mesh.names = io::in_quotes(nodes->name);
  mesh.is_single = nodes->type == io::NetcdfType::float32;
  const std::vector<double> counts = file.numbers(numbers);
  const double first = number_or(*elements, "start_index", 1);
  // take_connectivity() heeds a break value only if it is less than the first number.
  const double no_break = first;
  const double break_value = number_or(*elements, "polybreak_value", no_break);
  // The mask is read first, since corners of masked cells may be anything.
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

// ESMF has a list of nodes, to which the cells refer by numbers from 1.
void define_esmf(MeshFile& file, const CellCorners& corners) {
  const mesh::VoronoiMesh& arrays = file.arrays();
  const std::size_t size = arrays.num_cells();
  const std::size_t room = arrays.max_edges();
  const std::size_t nodes = file.dimension("nodeCount", arrays.num_vertices());
  const std::size_t cells = file.dimension("elementCount", size);
  const std::size_t max_corners = file.dimension("maxNodePElement", room);
  const std::size_t dimension = file.dimension("coordDim", 2);
  file.netcdf().add_attribute("gridType", "unstructured");
  file.netcdf().add_attribute("version", "0.9");
  define_pairs_of_degrees(file, "nodeCoords", {nodes, dimension}, arrays.vertex_points);
  auto connections =
      MeshFile::variable("elementConn", io::NetcdfType::int32, {cells, max_corners},
                         {{"long_name", "Node indices that define the element connectivity"}});
  MeshFile::set(connections, "_FillValue", esmf_none);
  MeshFile::set(connections, "start_index", 1);
  file.add<std::int32_t>(
      std::move(connections), size, room, [&corners, room](std::size_t cell, std::int32_t* out) {
        std::fill_n(out, room, esmf_none);
        corners.visit(cell, [&](Index v) { *out++ = static_cast<std::int32_t>(v + 1); });
      });
  if (room <= std::numeric_limits<std::int8_t>::max()) {
    define_counts<std::int8_t>(file, io::NetcdfType::int8, cells, corners);
  } else {
    define_counts<std::int32_t>(file, io::NetcdfType::int32, cells, corners);
  }
  define_pairs_of_degrees(file, "centerCoords", {cells, dimension}, arrays.cell_points);
  file.numbers("elementArea", cells, texts_of_areas, size,
               [&arrays](std::size_t i) { return area_at_one(arrays, i); });
  file.indices("elementMask", cells, {{"units", "unitless"}}, size, [](std::size_t) { return 1; });
}

}  // namespace rondel::formats
