// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads sites from netCDF files: read_netcdf_sites(). Sites are the centers of the cells if the
// file has cells with centers, or else the places of the fields; fields with one value at each site
// become columns of the table.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "formats/cf_reader.h"
#include "formats/grid_of_file.h"
#include "formats/netcdf_cells.h"
#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/netcdf_groups.h"
#include "io/number.h"
#include "rondel/conventions.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/named_grids.h"
#include "rondel/read_cells.h"
#include "system/job.h"

namespace rondel {
namespace {

// The variable of the first column that is asked for. `is_one_of_several` is true if the name picks
// one field of the variable.
struct NamedVariable {
  std::string name;
  bool is_one_of_several = false;
};

// Returns the variable of the first name, or an empty name if there are no names.
NamedVariable named_variable(const FileName& file, std::span<const std::string> names) {
  if (names.empty()) return {};
  io::FileBytes bytes(file, true);
  return io::in_file(bytes.name(), [&]() -> NamedVariable {
    const io::NetcdfReader reader(bytes);
    const std::string wanted = io::full_name(reader.variables(), names.front());
    const std::string name = formats::variable_of(reader, wanted);
    return {name, name != wanted};
  });
}

// Returns the centers of the cells that the variable is on, or nothing if the file has no cells
// with centers.
std::optional<NetcdfSites> centers_of_cells(const FileName& file, const std::string& variable) {
  try {
    io::FileBytes bytes(file, true);
    CellTable table = io::in_file(bytes.name(), [&] {
      const io::NetcdfReader reader(bytes);
      return formats::cells_in(reader, bytes.name(), variable);
    });
    CellFacts& cells = table.facts;
    std::vector<LonLat> centers = cells.given_centers();
    if (centers.empty() || centers.size() != table.num_cells()) return std::nullopt;
    if (cells.num_made_centers > 0) return std::nullopt;  // values are between places of the file
    for (std::size_t i = 0; i < cells.mask.size(); ++i) {
      // read_cells() puts missing centers to (0, 0).
      if (cells.mask[i] == 0 && centers[i] == LonLat{0, 0}) return std::nullopt;
    }
    NetcdfSites sites;
    sites.remarks = std::move(cells.remarks);
    sites.table.positions = std::move(centers);
    sites.shape = std::move(cells.shape);
    // With other conventions the mask only marks cells with missing corners.
    for (const std::string_view convention : {"SCRIP", "ESMF", "OASIS"}) {
      if (cells.convention == convention) sites.mask = cells.mask;
    }
    return sites;
  } catch (const FileError&) {
    return std::nullopt;  // fields need no cells
  }
}

// Returns the centers of the cells of the named grid that a file without longitudes and latitudes says
// it has: the pixels of HEALPix, whose files need no places.
std::vector<LonLat> centers_of_grid(const FileName& file) {
  io::FileBytes bytes(file, true);
  const bool has_places = io::in_file(bytes.name(), [&] {
    return !find_coordinates(formats::headers_of(io::NetcdfReader(bytes))).empty();
  });
  if (has_places) return {};
  const formats::GridOfFile found = formats::grid_of_file(file, false);
  if (found.name.empty()) return {};
  const NamedGrid grid(found.name);
  if (found.numbers.empty()) return grid.centers();
  std::vector<LonLat> centers;
  for (const Index number : found.numbers) centers.push_back(grid.center(number));
  return centers;
}

// Returns the middles of edges on which a variable is whose file has no places of edges.
std::vector<LonLat> middles_for(const FileName& file, const std::string& variable) {
  if (variable.empty()) return {};
  io::FileBytes bytes(file, true);
  return io::in_file(bytes.name(),
                     [&] { return formats::middles_of_edges(io::NetcdfReader(bytes), variable); });
}

// True if a variable is on the faces of a mesh of UGRID, or is the mesh itself.
bool is_on_faces(const io::VariableInFile& variable) {
  const auto text = [&](const char* name) { return io::netcdf_text(variable.attributes, name); };
  return (text("location") == "face" && !text("mesh").empty()) ||
         text("cf_role") == "mesh_topology";
}

// True if the places of a file as a whole are the faces of its mesh: one of its variables is on them,
// or none is on a mesh of UGRID at all; meshes of ESMF and Exodus have values on cells alone.
bool are_places_faces(const io::NetcdfReader& reader) {
  const std::vector<VariableHeader> headers = formats::headers_of(reader);
  if (!has_mesh(headers)) return false;
  bool is_elsewhere = false;
  for (const VariableHeader& header : headers) {
    const bool is_on_mesh = !header.text("mesh").empty();
    if (is_on_mesh && header.text("location") == "face") return true;
    is_elsewhere = is_elsewhere || (is_on_mesh && !header.text("location").empty());
  }
  return !is_elsewhere;
}

// Returns the centers of mass of the faces on which a variable is, or the file as a whole if none is
// named, where the file has no places of faces; with what was left out.
NetcdfSites centers_for(const FileName& file, const std::string& variable) {
  NetcdfSites sites;
  io::FileBytes bytes(file, true);
  const CellSet cells = CellSet::of(io::in_file(bytes.name(), [&] {
    const io::NetcdfReader reader(bytes);
    const bool are_faces =
        variable.empty() ? are_places_faces(reader) : is_on_faces(reader.require(variable));
    return are_faces ? formats::cells_in(reader, bytes.name(), variable) : CellTable();
  }));
  if (cells.num_cells() == 0 || !cells.facts().given_centers().empty()) return sites;
  sites.table.positions = cells.places();
  sites.mask = cells.facts().mask;
  sites.remarks = cells.facts().remarks;
  return sites;
}

// Returns what centers_for() returns, and nothing for a file as a whole whose cells cannot be read:
// its fields may have places all the same.
NetcdfSites centers_or_none(const FileName& file, const std::string& variable) {
  try {
    return centers_for(file, variable);
  } catch (const FileError&) {
    if (!variable.empty()) throw;
    return {};
  }
}

// Returns the longitudes of a file that has a list of places; empty if it has none.
std::string longitudes_of_list(const FileName& file) {
  io::FileBytes bytes(file, true);
  return io::in_file(bytes.name(), [&]() -> std::string {
    const std::vector<VariableHeader> headers = formats::headers_of(io::NetcdfReader(bytes));
    const std::vector<CoordinatePair> pairs = find_coordinates(headers);
    const bool has_list = !pairs.empty() && !pairs.front().are_axes &&
                          headers[pairs.front().lon].dimensions.size() == 1;
    return has_list ? headers[pairs.front().lon].name : std::string();
  });
}

// Returns an array with one value at each site as a column; missing values are empty cells.
Column column_of(const FieldArray& array) {
  Column column;
  column.name = array.name;
  column.is_numeric = true;
  for (const double value : array.values) {
    if (!std::isnan(value)) io::append_number(column.text, value);
    column.ends.push_back(column.text.size());
  }
  return column;
}

// Returns a message that an array has several fields and is no column.
std::string text_of_several(const FieldArray& array, const FieldSet& fields) {
  std::string text = io::in_quotes(array.name) + " has several fields (" +
                     array.lengths_in_words() + ") and is no column";
  const std::vector<std::string> names = names_of_fields(array, fields.axes);
  return names.empty() ? text : text + "; one of them is " + io::in_quotes(names.front());
}

// Adds the columns with these names, which are given as a user wrote them.
void add_columns(const FieldFile& file, std::span<const std::string> names, NetcdfSites& sites) {
  const FieldSet& fields = file.fields();
  for (std::size_t a = 0; a < fields.arrays.size(); ++a) {
    FieldArray array = fields.arrays[a];
    if (array.num_fields() != 1) {
      sites.remarks.push_back(text_of_several(array, fields));
      continue;
    }
    array.values.resize(fields.num_points);
    file.read(a, 0, array.values, Execution{.threads = 1});
    if (!names.empty()) array.name = names[a];
    sites.table.columns.push_back(column_of(array));
  }
}

}  // namespace

std::string formats::variable_of(const io::NetcdfReader& reader, const std::string& name) {
  if (name.empty() || reader.find(name) != nullptr) return name;
  std::string longest;
  for (const io::VariableInFile& variable : reader.variables()) {
    const std::size_t length = variable.name.size();
    const bool is_beginning = name.starts_with(variable.name) && length < name.size() &&
                              (name[length] == '[' || name[length] == '_');
    if (is_beginning && length > longest.size()) longest = variable.name;
  }
  return longest.empty() ? reader.require(name).name : longest;
}

namespace {

// The mesh of a file, and how many cells it has.
struct PlacesOfMesh {
  std::vector<LonLat> nodes;
  std::vector<LonLat> centers;
  std::size_t num_cells;
  std::vector<std::int32_t> mask;  // of the cells
  std::vector<std::string> remarks;
};

PlacesOfMesh places_of_mesh(const FileName& mesh) {
  const auto [file, part] = file_and_variable(mesh);
  io::FileBytes bytes(file, true);
  return io::in_file(bytes.name(), [&, name = part] {
    const io::NetcdfReader reader(bytes);
    formats::MeshContent content =
        formats::read_by_convention(reader, io::full_name(reader.variables(), name));
    return PlacesOfMesh{std::move(content.nodes), std::move(content.centers),
                        content.cells.num_cells(), std::move(content.mask),
                        std::move(content.remarks)};
  });
}

// True if values are at the nodes, false if they are at the cells.
bool are_at_nodes(const io::VariableInFile& variable, const PlacesOfMesh& mesh) {
  const std::size_t num_nodes = mesh.nodes.size();
  const auto has = [&](std::size_t length) {
    return std::ranges::count(variable.shape, length) > 0;
  };
  const std::string both =
      std::to_string(num_nodes) + " nodes and " + std::to_string(mesh.num_cells) + " cells";
  const std::string text = "variable " + io::in_quotes(variable.name);
  if (!has(num_nodes) && !has(mesh.num_cells)) {
    throw io::BadValue(text + " has no dimension of the length of the mesh, which has " + both);
  }
  if (num_nodes == mesh.num_cells) {
    throw io::BadValue(text + " may be at nodes or at cells: the mesh has " + both);
  }
  const std::uint64_t last = variable.shape.back();
  if (last == num_nodes || last == mesh.num_cells) return last == num_nodes;
  if (has(num_nodes) && has(mesh.num_cells)) {
    throw io::BadValue(text + " has dimensions of both lengths of the mesh, which has " + both);
  }
  return has(num_nodes);
}

}  // namespace

NetcdfSites read_sites_on_mesh(const FileName& data, const FileName& mesh,
                               std::span<const std::string> names, bool keep_columns) {
  const system::ArithmeticScope arithmetic;
  io::require_no_pipe(data.path);
  PlacesOfMesh places = places_of_mesh(mesh);
  const std::string variable = named_variable(data, names).name;
  NetcdfSites sites;
  sites.remarks = std::move(places.remarks);
  io::FileBytes bytes(data, true);
  const bool is_of_nodes = io::in_file(bytes.name(), [&] {
    const io::NetcdfReader reader(bytes);
    return are_at_nodes(reader.require(variable), places);
  });
  sites.table.positions = std::move(is_of_nodes ? places.nodes : places.centers);
  if (!is_of_nodes) sites.mask = std::move(places.mask);
  const std::string mesh_name = file_and_variable(mesh).first.path;
  if (sites.table.positions.empty()) {
    throw FileError(mesh_name + ": the mesh has no centers of its cells, which the values of " +
                    io::in_quotes(variable) + " are at");
  }
  const auto missing = std::ranges::find_if(sites.table.positions, formats::is_missing_place);
  if (missing != sites.table.positions.end()) {
    throw FileError(mesh_name + ": " + (is_of_nodes ? "node " : "the center of cell ") +
                    std::to_string(missing - sites.table.positions.begin()) + " has no place");
  }
  if (keep_columns) {
    add_columns(FieldFile(data, names, sites.table.positions.size()), names, sites);
  }
  sites.shape = {sites.table.positions.size()};
  sites.table.name = data.path;
  sites.table.first_line = 0;
  sites.table.sites = unit_vectors(sites.table.positions);
  return sites;
}

NetcdfSites read_netcdf_sites(const FileName& file, std::span<const std::string> names,
                              bool keep_columns) {
  const system::ArithmeticScope arithmetic;
  if (file.bytes == nullptr) io::require_no_pipe(file.path);
  NetcdfSites sites;
  const NamedVariable named = named_variable(file, names);
  if (std::optional<NetcdfSites> centers = centers_of_cells(file, named.name)) {
    sites = std::move(*centers);
  } else {
    sites.table.positions = centers_of_grid(file);
    if (sites.table.positions.empty()) sites.table.positions = middles_for(file, named.name);
    if (sites.table.positions.empty()) sites = centers_or_none(file, named.name);
  }
  const std::size_t num_centers = sites.table.positions.size();
  // The fields are needed if they give the sites or the columns, or if the name picks one of
  // several, which then must exist.
  if (num_centers == 0 || keep_columns || named.is_one_of_several) {
    try {
      const FieldFile fields(file, names, num_centers, {}, {}, {sites.table.positions, 1e-9});
      if (num_centers == 0) {
        const std::string& remark = fields.fields().remark_on_grids;
        if (!remark.empty()) sites.remarks.push_back(remark);
        sites.table.positions = fields.fields().positions;
        sites.shape = fields.fields().shape;
        if (const std::size_t number = fields.fields().num_without_place; number > 0) {
          sites.remarks.push_back(std::to_string(number) + " of " +
                                  std::to_string(number + fields.fields().num_points) +
                                  " places have no longitude or latitude and are left out");
        }
      }
      if (keep_columns) add_columns(fields, names, sites);
      if (keep_columns && names.empty()) {
        const std::vector<std::string>& left_out = fields.fields().remarks;
        sites.remarks.insert(sites.remarks.end(), left_out.begin(), left_out.end());
      }
    } catch (const FileError&) {
      // A list of stations or the points of a track may have no fields.
      if (num_centers == 0 && names.empty() && !keep_columns) {
        const std::string lon = longitudes_of_list(file);
        if (!lon.empty()) return read_netcdf_sites(file, {&lon, 1}, false);
      }
      if (num_centers == 0 || !names.empty()) throw;  // a mesh may have no fields
    }
  }
  sites.table.name = file.path;
  sites.table.first_line = 0;
  sites.table.sites = unit_vectors(sites.table.positions);
  return sites;
}

}  // namespace rondel
