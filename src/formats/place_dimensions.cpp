// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the dimensions along which places change: those of longitudes and latitudes, of the nodes,
// edges and faces of meshes, and of the axes x and y, also where a model staggers them.
//
// in    headers of variables
// out   for each variable whether it has such a dimension
#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "formats/cf_names.h"
#include "formats/variable_index.h"
#include "rondel/conventions.h"

namespace rondel {
namespace {

// Names of dimensions in lower case, row by row: axes of grids; POP, CICE and CMIP; MOM6, FV3 and
// MITgcm; MPAS; CAM and CDO; UGRID and FVCOM; FESOM; ESMF and SCRIP.
constexpr std::array<std::string_view, 52> place_names = {
    "lon",         "lat",         "longitude",
    "latitude",    "lons",        "lats",
    "rlon",        "rlat",        "x",
    "y",           "nlon",        "nlat",
    "ni",          "nj",          "i",
    "j",           "xh",          "yh",
    "xq",          "yq",          "grid_xt",
    "grid_yt",     "grid_x",      "grid_y",
    "xc",          "yc",          "xg",
    "yg",          "ncells",      "nedges",
    "nvertices",   "cell",        "cells",
    "edge",        "edges",       "ncol",
    "node",        "nodes",       "face",
    "faces",       "n_face",      "n_edge",
    "n_node",      "nele",        "nmesh2_face",
    "nmesh2_edge", "nmesh2_node", "nod2",
    "elem",        "nodecount",   "elementcount",
    "grid_size"};

// ROMS and WRF stagger their grids: xi_u, eta_psi, west_east_stag.
constexpr std::array<std::string_view, 4> place_beginnings = {"xi_", "eta_", "west_east",
                                                              "south_north"};

// Returns the name without the number by which CDO tells grids apart, "ncells_2".
std::string_view without_number(std::string_view name) {
  std::size_t end = name.size();
  while (end > 0 && std::isdigit(static_cast<unsigned char>(name[end - 1])) != 0) --end;
  return end > 0 && end < name.size() && name[end - 1] == '_' ? name.substr(0, end - 1) : name;
}

}  // namespace

bool formats::is_dimension_of_places(const std::string& dimension) {
  const std::string lower = formats::lower_case(dimension);
  return std::ranges::find(place_names, without_number(lower)) != place_names.end() ||
         std::ranges::any_of(place_beginnings, [&](std::string_view beginning) {
           return lower.starts_with(beginning);
         });
}

namespace {

// Knows the dimensions of places of a file.
class PlaceDimensions {
 public:
  explicit PlaceDimensions(std::span<const VariableHeader> variables)
      : variables_(variables), index_(variables) {
    for (const VariableHeader& variable : variables) {
      if (is_axis_of_places(variable)) found_.insert(variable.dimensions[0]);
      add_topology(variable);
    }
    for (const CoordinatePair& pair : find_coordinates(variables)) {
      add_all(variables[pair.lon]);
      add_all(variables[pair.lat]);
    }
    for (const VariableHeader& variable : variables) add_gathered(variable);
  }

  // True if the variable has such a dimension, or says that it is on a mesh.
  [[nodiscard]] bool are_of(const VariableHeader& variable) const {
    if (variable.dimensions.empty()) return false;
    const bool is_on_mesh = !variable.text("mesh").empty() && !variable.text("location").empty();
    return is_on_mesh || has_any_of(variable.dimensions);
  }

 private:
  // True if one of the dimensions is such a dimension.
  [[nodiscard]] bool has_any_of(const std::vector<std::string>& dimensions) const {
    return std::ranges::any_of(dimensions, [&](const std::string& name) {
      return found_.contains(name) || formats::is_dimension_of_places(name);
    });
  }
  // Adds the dimension of an index whose attribute `compress` names dimensions of places.
  void add_gathered(const VariableHeader& index) {
    if (index.dimensions.size() != 1) return;
    if (has_any_of(formats::words_of(index.text("compress")))) found_.insert(index.dimensions[0]);
  }

  // True for an axis of longitude, latitude, x or y, and for the longitudes or latitudes of vertices
  // or edges.
  [[nodiscard]] static bool is_axis_of_places(const VariableHeader& variable) {
    if (variable.dimensions.size() != 1) return false;
    for (const CoordinateKind kind : {CoordinateKind::lon, CoordinateKind::lat}) {
      if (formats::is_name_of_part(variable.name, kind)) return true;
    }
    if (variable.dimensions[0] != variable.name) return false;
    const std::string axis = variable.text("axis");
    return axis == "X" || axis == "Y" || formats::is_rotated_or_projected(variable) ||
           formats::coordinate_evidence(variable, CoordinateKind::lon) > 0 ||
           formats::coordinate_evidence(variable, CoordinateKind::lat) > 0;
  }

  // Adds what a topology of UGRID says: `face_dimension`, or else the first dimension of the
  // variable of `face_node_connectivity`; and those of `node_coordinates`.
  void add_topology(const VariableHeader& topology) {
    for (const auto& [attribute, text] : topology.texts) {
      const bool is_of_part = attribute.starts_with("node_") || attribute.starts_with("edge_") ||
                              attribute.starts_with("face_");
      if (!is_of_part) continue;
      if (attribute.ends_with("_dimension")) found_.insert(text);
      if (attribute.ends_with("_coordinates")) {
        for (const std::string& name : formats::words_of(text)) {
          if (const VariableHeader* const places = find(name)) add_all(*places);
        }
      }
      const std::string part = attribute.substr(0, attribute.find('_'));
      const bool is_list = attribute.ends_with("_connectivity");
      if (!is_list || !topology.text(part + "_dimension").empty()) continue;
      const VariableHeader* const list = find(text);
      if (list != nullptr && !list->dimensions.empty()) found_.insert(list->dimensions[0]);
    }
  }

  // Adds the dimensions of coordinates but for time, along which places are repeated.
  void add_all(const VariableHeader& coordinate) {
    for (const std::string& name : coordinate.dimensions) {
      if (!is_name_of_time(name)) found_.insert(name);
    }
  }

  [[nodiscard]] const VariableHeader* find(std::string_view name) const {
    const std::size_t at = index_.find(name);
    return at == formats::VariableIndex::none ? nullptr : &variables_[at];
  }

  using CoordinateKind = formats::CoordinateKind;
  std::span<const VariableHeader> variables_;
  formats::VariableIndex index_;
  std::set<std::string> found_;
};

}  // namespace

std::vector<bool> are_at_places(std::span<const VariableHeader> variables) {
  const PlaceDimensions places(variables);
  std::vector<bool> result;
  result.reserve(variables.size());
  for (const VariableHeader& variable : variables) result.push_back(places.are_of(variable));
  return result;
}

}  // namespace rondel
