// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// UGRID for meshes of triangles: nodes, edges, faces, and the border as `boundary_node_connectivity`,
// for each of whose edges `boundary_segment` has the number of its segment, `boundary_kind` 0, 1 or 2
// for open, land and island, and `boundary_type` ADCIRC's type, if segments have types. `depth` is at
// the nodes. Files of others are read, too, if all faces are triangles.
#include <algorithm>
#include <string>

#include "formats/cf_names.h"
#include "formats/cf_reader.h"
#include "formats/mesh_file.h"
#include "formats/netcdf_cells.h"
#include "formats/ocean_lines.h"
#include "formats/sea_floor.h"
#include "io/bad_value.h"
#include "io/number.h"

namespace rondel::formats {
namespace {

using io::BadValue;
using mesh::BoundarySegment;

constexpr std::int32_t no_type = -1;

// The edges of the border, each with the number of its segment.
struct BorderRow {
  std::array<Index, 2> nodes;
  std::size_t segment;
};

std::vector<BorderRow> border_rows(const mesh::TriangleMesh& mesh) {
  std::vector<BorderRow> rows;
  for (std::size_t s = 0; s < mesh.boundary.size(); ++s) {
    const std::vector<Index> nodes = closed_nodes(mesh.boundary[s]);
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      rows.push_back({{nodes[k - 1], nodes[k]}, s});
    }
  }
  return rows;
}

// Returns all edges, the lower node first, in lexicographic order.
std::vector<std::array<Index, 2>> edges_of(std::span<const Triple> triangles) {
  std::vector<std::array<Index, 2>> edges;
  for (const Triple& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      edges.push_back({low, high});
    }
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

template <class Row>
void define_index_rows(MeshFile& file, io::NetcdfVariable variable, const std::vector<Row>& rows) {
  file.add<std::int32_t>(std::move(variable), rows.size(), std::tuple_size_v<Row>,
                         [&rows](std::size_t i, std::int32_t* out) {
                           for (const Index index : rows[i]) {
                             *out++ = static_cast<std::int32_t>(index);
                           }
                         });
}

// Defines the variables of the border.
void define_border(MeshFile& file, const mesh::TriangleMesh& mesh,
                   const std::vector<BorderRow>& rows, std::size_t two) {
  const std::size_t border = file.dimension("n_boundary", rows.size());
  file.add<std::int32_t>(
      ugrid_indices("boundary_nodes", "boundary_node_connectivity", {border, two}, false),
      rows.size(), 2, [&rows](std::size_t i, std::int32_t* out) {
        out[0] = static_cast<std::int32_t>(rows[i].nodes[0]);
        out[1] = static_cast<std::int32_t>(rows[i].nodes[1]);
      });
  file.indices("boundary_segment", border, {{"long_name", "number of the segment, from 0"}},
               rows.size(), [&rows](std::size_t i) { return rows[i].segment; });
  auto kinds = MeshFile::variable("boundary_kind", io::NetcdfType::int32, {border},
                                  {{"flag_meanings", "open land island"}});
  kinds.attributes.push_back({"flag_values", io::NetcdfType::int32, "", {0, 1, 2}});
  file.add<std::int32_t>(std::move(kinds), rows.size(), 1, [&](std::size_t i, std::int32_t* out) {
    *out = static_cast<std::int32_t>(mesh.boundary[rows[i].segment].kind);
  });
  const bool has_types = std::ranges::any_of(
      mesh.boundary, [](const BoundarySegment& segment) { return segment.type.has_value(); });
  if (!has_types) return;
  auto types = MeshFile::variable("boundary_type", io::NetcdfType::int32, {border},
                                  {{"long_name", "ADCIRC's IBTYPE"}});
  MeshFile::set(types, "_FillValue", no_type);
  file.add<std::int32_t>(std::move(types), rows.size(), 1, [&](std::size_t i, std::int32_t* out) {
    *out = mesh.boundary[rows[i].segment].type.value_or(no_type);
  });
}

// Returns the variable of edges of the border that a topology names; null if there is none.
const io::VariableInFile* border_in(const io::NetcdfReader& file, const std::string& part) {
  for (const io::VariableInFile& variable : file.variables()) {
    const std::string name = io::netcdf_text(variable.attributes, "boundary_node_connectivity");
    if (!name.empty() && (part.empty() || variable.name == part)) return &file.require(name);
  }
  return nullptr;
}

// Reads one integer for each edge of the border.
std::vector<std::int64_t> border_numbers(const io::NetcdfReader& reader, const char* name,
                                         std::uint64_t count) {
  const io::VariableInFile& variable = reader.require(name);
  require_values(variable, count);
  return reader.integers(variable);
}

// Reads segments: runs of edges with one number.
void read_border(const io::NetcdfReader& reader, const std::string& part, MeshInFile& file) {
  const io::VariableInFile* const border = border_in(reader, part);
  if (border == nullptr || reader.find("boundary_segment") == nullptr ||
      reader.find("boundary_kind") == nullptr) {
    return;
  }
  require_rank(*border, 2);
  const std::uint64_t count = border->shape[0];
  require_values(*border, 2 * count);
  const std::vector<std::int64_t> nodes = reader.integers(*border);
  const auto first = static_cast<std::int64_t>(number_or(*border, "start_index", 0));
  const std::vector<std::int64_t> numbers = border_numbers(reader, "boundary_segment", count);
  const std::vector<std::int64_t> kinds = border_numbers(reader, "boundary_kind", count);
  std::vector<std::int64_t> types;
  if (reader.find("boundary_type") != nullptr) {
    types = border_numbers(reader, "boundary_type", count);
  }
  BoundarySegment segment;
  for (std::uint64_t i = 0; i < count; ++i) {
    io::at_item("boundary", i, [&] {
      const auto node = [&](std::uint64_t k) {
        return io::checked_index(nodes[2 * i + k] - first);
      };
      if (i == 0 || numbers[i] != numbers[i - 1]) {
        if (i > 0) add_segment(file, std::move(segment));
        segment = {};
        segment.kind = static_cast<mesh::BoundaryKind>(
            kinds[i] < 0 || kinds[i] > 2 ? throw BadValue("the kind " + std::to_string(kinds[i]))
                                         : kinds[i]);
        if (!types.empty() && types[i] != no_type) {
          segment.type = static_cast<std::int32_t>(std::clamp<std::int64_t>(types[i], -1, 1000));
        }
        segment.nodes.push_back(node(0));
      } else if (segment.nodes.back() != node(0)) {
        throw BadValue("the edge does not follow the one before in segment " +
                       std::to_string(numbers[i]));
      }
      segment.nodes.push_back(node(1));
    });
  }
  if (count > 0) add_segment(file, std::move(segment));
  file.has_boundary = count > 0;
}

// Returns the direction in which a variable of depths or heights of the sea floor is positive; nothing
// for other variables. The standard_name says it, also in the spellings of ADCIRC's files; or, where
// there is none, the name.
std::optional<mesh::Positive> sense_of_sea_floor(const io::VariableInFile& variable) {
  const std::string name = standard_name_of(io::netcdf_text(variable.attributes, "standard_name"));
  const bool is_depth = name.starts_with("sea_floor_depth") ||
                        name.starts_with("model_sea_floor_depth") ||
                        name.starts_with("depth_below_") || name == "depth";
  const bool is_height = name == "altitude" || name.starts_with("height_above_geoid") ||
                         name.starts_with("height_above_mean_sea_level") ||
                         name.starts_with("sea_floor_altitude");
  const bool is_named = name.empty() && lower_case(variable.name) == "depth";
  if (!is_depth && !is_height && !is_named) return std::nullopt;
  const auto given = vertical_sense_of(io::netcdf_text(variable.attributes, "positive"), name);
  if (given) return given->positive;
  return mesh::Positive::down;
}

// Returns the variable of depths or heights at the nodes, one with a standard_name if there is one;
// null if there is none.
const io::VariableInFile* find_depths(const io::NetcdfReader& reader, std::size_t num_nodes) {
  const io::VariableInFile* found = nullptr;
  for (const io::VariableInFile& variable : reader.variables()) {
    const bool is_at_nodes = variable.shape.size() == 1 && variable.num_values == num_nodes;
    if (!is_at_nodes || variable.type == io::NetcdfType::text || !sense_of_sea_floor(variable)) {
      continue;
    }
    if (!io::netcdf_text(variable.attributes, "standard_name").empty()) return &variable;
    if (found == nullptr) found = &variable;
  }
  return found;
}

// Reads the depths at the nodes, if there are some: CF's, ADCIRC's, or the altitude of the nodes, as
// Delft3D FM has it. Returns the name of the variable, or an empty text.
std::string read_depths(const io::NetcdfReader& reader, MeshInFile& file) {
  const io::VariableInFile* const variable = find_depths(reader, file.mesh.positions.size());
  if (variable == nullptr) return {};
  const std::string units = io::netcdf_text(variable->attributes, "units");
  const auto kilometers = without_blanks(units).empty() ? 1e-3 : kilometers_of_units(units);
  if (!kilometers) {
    throw BadValue("variable " + io::in_quotes(variable->name) + " has the units " +
                   io::in_quotes(units) + ", which are neither meters nor kilometers");
  }
  const bool is_up = sense_of_sea_floor(*variable) == mesh::Positive::up;
  file.mesh.depths = meant_numbers(reader, *variable);
  for (double& depth : file.mesh.depths) {
    depth *= *kilometers * 1000;
    if (is_up) depth = 0 - depth;
  }
  return variable->name;
}

}  // namespace

bool has_triangles_without_centers(const io::NetcdfReader& reader) {
  return std::ranges::any_of(reader.variables(), [&](const io::VariableInFile& mesh) {
    const std::string faces = io::netcdf_text(mesh.attributes, "face_node_connectivity");
    const io::VariableInFile* const nodes = faces.empty() ? nullptr : reader.find(faces);
    return nodes != nullptr && nodes->shape.size() == 2 &&
           std::ranges::count(nodes->shape, 3) > 0 &&
           io::netcdf_text(mesh.attributes, "face_coordinates").empty();
  });
}

void read_ugrid_triangles(const io::NetcdfReader& reader, const std::string& part,
                          MeshInFile& file) {
  file.base = 0;
  std::optional<MeshContent> content = read_ugrid(reader, part);
  if (!content) throw BadValue("there is no mesh of UGRID");
  file.remarks = std::move(content->remarks);
  for (std::size_t i = 0; i < content->nodes.size(); ++i) {
    io::at_item("node", i,
                [&] { add_node(file, content->nodes[i].lon_deg, content->nodes[i].lat_deg); });
  }
  const CellRings& cells = content->cells;
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    const bool is_ring = cells.cells[i + 1] - cells.cells[i] == 1;
    const auto corners = is_ring ? cells.corners_of(cells.cells[i]) : std::span<const Index>();
    if (corners.size() != 3) {
      throw BadValue("face " + std::to_string(i) + " has " + std::to_string(corners.size()) +
                     " corners, where a triangle is needed");
    }
    file.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  const std::string own[] = {read_depths(reader, file), "boundary_segment", "boundary_kind",
                             "boundary_type"};
  const std::string remark = remark_on_fields(reader, own);
  if (!remark.empty()) file.remarks.push_back(remark);
  read_border(reader, part, file);
}

void write_ugrid_triangles(io::AtomicFile& output, const MeshOfFile& mesh,
                           const NetcdfOptions& options) {
  const mesh::TriangleMesh& arrays = mesh.mesh;
  const std::vector<BorderRow> border = border_rows(arrays);
  const std::vector<std::array<Index, 2>> edges = edges_of(arrays.triangles);
  MeshFile file(output, mesh.execution);
  const std::size_t nodes = file.dimension("n_node", arrays.points.size());
  const std::size_t edge = file.dimension("n_edge", edges.size());
  const std::size_t faces = file.dimension("n_face", arrays.triangles.size());
  const std::size_t three = file.dimension("three", 3);
  const std::size_t two = file.dimension("two", 2);
  file.netcdf().add_attribute("Conventions", "CF-1.11 UGRID-1.0");
  file.netcdf().add_attribute("title", "Triangles");
  auto topology = MeshFile::variable("mesh", io::NetcdfType::int32, {},
                                     {{"cf_role", "mesh_topology"},
                                      {"node_coordinates", "node_lon node_lat"},
                                      {"face_node_connectivity", "face_nodes"},
                                      {"edge_node_connectivity", "edge_nodes"},
                                      {"face_dimension", "n_face"},
                                      {"edge_dimension", "n_edge"}});
  if (!border.empty()) {
    topology.attributes.push_back(
        {"boundary_node_connectivity", io::NetcdfType::text, "boundary_nodes", {}});
  }
  MeshFile::set(topology, "topology_dimension", 2);
  // The topology is a variable without dimensions, whose value is 0.
  file.add<std::int32_t>(std::move(topology), 1, 1, [](std::size_t, std::int32_t*) {});
  file.numbers("node_lon", nodes, texts_of_longitudes, mesh.positions.size(),
               [&](std::size_t i) { return mesh.positions[i].lon_deg; });
  file.numbers("node_lat", nodes, texts_of_latitudes, mesh.positions.size(),
               [&](std::size_t i) { return mesh.positions[i].lat_deg; });
  if (!arrays.depths.empty()) {
    file.numbers("depth", nodes,
                 {{"units", "m"},
                  {"positive", "down"},
                  {"standard_name", "sea_floor_depth_below_geoid"},
                  {"mesh", "mesh"},
                  {"location", "node"},
                  {"coordinates", "node_lon node_lat"}},
                 arrays.depths.size(), [&](std::size_t i) { return arrays.depths[i]; });
  }
  define_index_rows(file,
                    ugrid_indices("face_nodes", "face_node_connectivity", {faces, three}, false),
                    arrays.triangles);
  define_index_rows(file, ugrid_indices("edge_nodes", "edge_node_connectivity", {edge, two}, false),
                    edges);
  if (!border.empty()) define_border(file, arrays, border, two);
  file.write(options);
}

}  // namespace rondel::formats
