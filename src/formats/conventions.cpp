// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Recognizes meshes and grids by the names of their variables: those of each convention that a file
// of this folder reads, and NEMO's by the names of its files of coordinates (NEMO reference manual,
// "domain configuration file").
#include "rondel/conventions.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "formats/cf_names.h"
#include "formats/netcdf_cells.h"
#include "formats/variable_index.h"
#include "formats/weight_formats.h"
#include "io/number.h"
#include "rondel/named_grids.h"
#include "system/message_text.h"

namespace rondel {
namespace {

// A convention by a variable that all of its files have, and the names of its others.
struct GridNames {
  std::string_view mark;
  std::array<std::string_view, 5> names;
};
// The rows are ESMF, SCRIP with and without corners, and ICON.
constexpr std::array grid_names = {
    GridNames{"elementConn",
              {"nodeCoords", "elementConn", "numElementConn", "centerCoords", "elementMask"}},
    GridNames{"grid_corner_lon",
              {"grid_center_lon", "grid_center_lat", "grid_corner_lon", "grid_corner_lat", ""}},
    GridNames{"grid_center_lon",
              {"grid_center_lon", "grid_center_lat", "grid_imask", "grid_dims", ""}},
    GridNames{"vertex_of_cell", {"clon", "clat", "vlon", "vlat", "edge_vertices"}},
};

// Knows which variables of a file describe its grid, and are no fields.
class GridParts {
 public:
  // Collects the variables that a topology of UGRID names, such as those of
  // `face_node_connectivity` and `node_coordinates`.
  explicit GridParts(std::span<const VariableHeader> variables) : index_(variables) {
    for (const VariableHeader& variable : variables) {
      if (!is_topology(variable)) continue;
      for (const auto& [attribute, text] : variable.texts) {
        if (!attribute.ends_with("_connectivity") && !attribute.ends_with("_coordinates")) continue;
        for (std::string& word : formats::words_of(text)) named_.insert(std::move(word));
      }
    }
  }

  // True if the variable belongs to the description of a grid or mesh.
  [[nodiscard]] bool has(const VariableHeader& variable) const {
    const std::string& name = variable.name;
    return is_topology(variable) || formats::is_connectivity(variable) || named_.contains(name) ||
           is_of_list(name) || is_of_mpas(name) || is_of_nemo(name) || is_of_oasis(name) ||
           is_of_exodus(name);
  }

 private:
  // True for a variable that says of which parts a mesh of UGRID consists, or on which of them values are.
  [[nodiscard]] static bool is_topology(const VariableHeader& variable) {
    const std::string role = variable.text("cf_role");
    return role == "mesh_topology" || role == "location_index_set" ||
           variable.text("standard_name") == "mesh_topology";
  }
  // True if the file has a variable of this name.
  [[nodiscard]] bool is_there(std::string_view name) const { return index_.has(name); }

  // True for a name of SCRIP, ESMF or ICON, in a file of that convention.
  [[nodiscard]] bool is_of_list(std::string_view name) const {
    return std::ranges::any_of(grid_names, [&](const GridNames& grid) {
      return std::ranges::find(grid.names, name) != grid.names.end() && is_there(grid.mark);
    });
  }

  // True for a coordinate of MPAS, such as xCell or latVertex.
  [[nodiscard]] bool is_of_mpas(std::string_view name) const {
    if (!is_there("verticesOnCell") && !is_there("indexToCellID")) return false;
    for (const std::string_view coordinate : {"x", "y", "z", "lon", "lat"}) {
      if (!name.starts_with(coordinate)) continue;
      const std::string_view place = name.substr(coordinate.size());
      if (place == "Cell" || place == "Edge" || place == "Vertex") return true;
    }
    return name == "boundaryVertex";
  }

  // True for a coordinate of NEMO, glamt or gphit, if the file has both.
  [[nodiscard]] bool is_of_nemo(std::string_view name) const {
    if (name.size() != 5 || std::string_view("tuvwf").find(name[4]) == std::string_view::npos)
      return false;
    const std::string_view other = name.starts_with("glam")   ? "gphi"
                                   : name.starts_with("gphi") ? "glam"
                                                              : "";
    return !other.empty() && is_there(std::string(other) + name[4]);
  }

  // True for a part of a grid of OASIS, such as torc.clo, if the file has torc.lon and torc.lat.
  [[nodiscard]] bool is_of_oasis(std::string_view name) const {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos) return false;
    const std::string grid(name.substr(0, dot));
    const std::string_view part = name.substr(dot + 1);
    const bool is_part = part == "lon" || part == "lat" || part == "clo" || part == "cla" ||
                         part == "msk" || part == "ang";
    return is_part && is_there(grid + ".lon") && is_there(grid + ".lat");
  }

  // True for a variable of Exodus II that describes elements.
  [[nodiscard]] bool is_of_exodus(std::string_view name) const {
    if (!is_there("connect1")) return false;
    return std::ranges::any_of(
        std::array<std::string_view, 6>{"connect", "coord", "global_id", "edge_type", "eb_",
                                        "elem_num_map"},
        [&](std::string_view beginning) { return name.starts_with(beginning); });
  }

  formats::VariableIndex index_;
  std::set<std::string> named_;  // by a topology of UGRID
};

// True for a name of areas of cells: in MPAS, ICON, CMIP, SCRIP, ESMF, POP and CICE; or for `area`, as in
// CESM and NEMO, if the units are those of areas.
bool is_named_like_area(const VariableHeader& variable) {
  constexpr std::array<std::string_view, 13> names = {
      "areaCell",  "areaTriangle", "cell_area", "dual_area",    "areacella",
      "areacello", "areacellr",    "grid_area", "element_area", "elementArea",
      "tarea",     "uarea",        "cell_areas"};
  constexpr std::array<std::string_view, 12> units = {
      "m2",   "m^2",          "m**2",      "km2",        "km^2", "km**2",
      "cm^2", "centimeter^2", "steradian", "steradians", "sr",   "radians^2"};
  const std::string lower = formats::lower_case(variable.name);
  if (lower == "area") {
    return std::ranges::count(units, formats::without_blanks(variable.text("units"))) != 0;
  }
  return std::ranges::count(names, variable.name) != 0 || std::ranges::count(names, lower) != 0;
}

}  // namespace

std::vector<bool> parts_of_grids(std::span<const VariableHeader> variables) {
  const GridParts parts(variables);
  std::vector<bool> result;
  result.reserve(variables.size());
  for (const VariableHeader& variable : variables) result.push_back(parts.has(variable));
  return result;
}

std::vector<bool> are_measures_of_cells(std::span<const VariableHeader> variables) {
  std::set<std::string, std::less<>> named;
  for (const VariableHeader& variable : variables) {
    for (std::string& word : formats::words_of(variable.text("cell_measures"))) {
      if (!word.ends_with(':')) named.insert(std::move(word));
    }
  }
  std::vector<bool> result;
  result.reserve(variables.size());
  for (const VariableHeader& variable : variables) {
    result.push_back(named.contains(variable.name) ||
                     variable.text("standard_name") == "cell_area" || is_named_like_area(variable));
  }
  return result;
}

bool is_attribute_of_names(std::string_view attribute) {
  constexpr std::array<std::string_view, 6> names = {
      "coordinates", "ancillary_variables", "bounds", "climatology", "formula_terms", "compress"};
  return std::ranges::find(names, attribute) != names.end();
}

std::string with_names(std::string_view attribute, const std::string& text,
                       const std::function<std::string(const std::string&)>& name_of) {
  if (!is_attribute_of_names(attribute)) return {};
  const bool is_formula = attribute == "formula_terms";
  const bool needs_all = attribute != "coordinates" && attribute != "ancillary_variables";
  std::string kept;
  for (const std::string& word : formats::words_of(text)) {
    // In "ps: surface" the first word is a term of the formula.
    const std::string name = is_formula && word.ends_with(':') ? word : name_of(word);
    if (name.empty() && needs_all) return {};
    if (!name.empty()) kept.append(kept.empty() ? "" : " ").append(name);
  }
  return kept;
}

bool has_mesh(std::span<const VariableHeader> variables) {
  // These are marks of MPAS, SCRIP, ESMF, ICON and Exodus; the attribute below is UGRID's.
  constexpr std::array<std::string_view, 5> marks = {"verticesOnCell", "grid_corner_lon",
                                                     "elementConn", "vertex_of_cell", "connect1"};
  return std::ranges::any_of(variables, [&](const VariableHeader& variable) {
    return std::ranges::find(marks, variable.name) != marks.end() ||
           !variable.text("face_node_connectivity").empty();
  });
}

bool is_attribute_of_places(std::string_view name) {
  constexpr std::string_view names[] = {
      // of CF, UGRID and CDI
      "coordinates", "bounds", "climatology", "cell_measures", "grid_mapping", "formula_terms",
      "ancillary_variables", "mesh", "location", "compress", "interpolation", "grid",
      "actual_range", "number_of_grid_in_reference", "number_of_grid_used", "uuidOfHGrid",
      "featureType",
      // of CMIP
      "nominal_resolution", "grid_label",
      // of WRF; its attributes of the vertical grid stay
      "stagger", "MemoryOrder", "GRIDTYPE", "MAP_PROJ", "MAP_PROJ_CHAR", "DX", "DY", "CEN_LAT",
      "CEN_LON", "TRUELAT1", "TRUELAT2", "MOAD_CEN_LAT", "STAND_LON", "POLE_LAT", "POLE_LON",
      "I_PARENT_START", "J_PARENT_START",
      // of MPAS
      "on_a_sphere", "sphere_radius", "is_periodic", "x_period", "y_period", "mesh_spec", "mesh_id",
      // of how numbers are stored
      "_Unsigned", "_FillValue", "missing_value", "_ChunkSizes", "_DeflateLevel", "_Shuffle",
      "_Storage", "_Endianness", "_Fletcher32", "_Filter", "_NoFill", "GRIB_missingValue",
      // of GRIB by cfgrib
      "GRIB_gridType", "GRIB_gridDefinitionDescription", "GRIB_numberOfPoints", "GRIB_Nx",
      "GRIB_Ny", "GRIB_N", "GRIB_pl", "GRIB_iScansNegatively", "GRIB_jScansPositively",
      "GRIB_jPointsAreConsecutive",
      // of own files
      grid_attribute, formats::source_corners_name, formats::target_corners_name};
  constexpr std::string_view beginnings[] = {
      "CDI_grid_",       "GRIB_latitudeOf", "GRIB_longitudeOf", "GRIB_iDirection",
      "GRIB_jDirection", "geospatial_lat_", "geospatial_lon_",  "geospatial_bounds",
      "WEST-EAST_",      "SOUTH-NORTH_",    "WEST_EAST_",       "SOUTH_NORTH_"};
  return std::ranges::find(names, name) != std::end(names) ||
         std::ranges::any_of(
             beginnings, [&](std::string_view beginning) { return name.starts_with(beginning); });
}

bool is_attribute_of_values(std::string_view name) {
  constexpr std::string_view names[] = {"dtype",
                                        "minimum",
                                        "maximum",
                                        "data_min",
                                        "data_max",
                                        "actual_min",
                                        "actual_max",
                                        "actual_range",
                                        "valid_count",
                                        "unpacked_valid_range",
                                        "unpacked_missing_value",
                                        "STATISTICS_MINIMUM",
                                        "STATISTICS_MAXIMUM",
                                        "STATISTICS_MEAN",
                                        "STATISTICS_STDDEV",
                                        "STATISTICS_VALID_PERCENT"};
  return std::ranges::find(names, name) != std::end(names);
}

bool is_attribute_of_flags(std::string_view name) {
  return name == "flag_values" || name == "flag_masks" || name == "flag_meanings";
}

std::string remark_on_meridian(std::span<const VariableHeader> variables,
                               std::string_view coordinate,
                               std::span<const std::pair<std::string, double>> meridians) {
  const auto found = std::ranges::find(variables, coordinate, &VariableHeader::name);
  if (found == variables.end()) return {};
  const auto has_dimensions = [&](const VariableHeader& variable) {
    return std::ranges::all_of(found->dimensions, [&](const std::string& dimension) {
      return std::ranges::count(variable.dimensions, dimension) > 0;
    });
  };
  for (const VariableHeader& variable : variables) {
    for (std::string& word : formats::words_of(variable.text("grid_mapping"))) {
      if (word.ends_with(':')) word.pop_back();
      // In a group of netCDF the mapping is called group/crs.
      const auto known = std::ranges::find_if(meridians, [&](const auto& mapping) {
        return mapping.first == word || mapping.first.ends_with('/' + word);
      });
      if (known == meridians.end() || known->second == 0 || !has_dimensions(variable)) continue;
      const std::string number = system::shortest_text(known->second);
      std::string why = "the longitudes count from the meridian at ";
      return why.append(number)
          .append(" degrees east of Greenwich (longitude_of_prime_meridian of variable ")
          .append(io::in_quotes(word))
          .append("): add ")
          .append(number)
          .append(" to them, and set the attribute to 0 or remove it");
    }
  }
  return {};
}

bool is_planar(std::span<const std::pair<std::string, std::string>> texts) {
  return std::ranges::any_of(texts, [](const auto& attribute) {
    return attribute.first == "on_a_sphere" &&
           formats::lower_case(formats::without_blanks(attribute.second)) == "no";
  });
}

}  // namespace rondel
