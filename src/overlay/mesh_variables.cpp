// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the conventions of cells share.
#include <algorithm>
#include <cmath>
#include <string>

#include "io/bad_value.h"
#include "io/number.h"
#include "overlay/mesh_formats.h"

namespace rondel::overlay {
namespace {

using io::BadValue;

void require_values(const MeshVariable& variable, std::uint64_t wanted) {
  if (variable.num_values == wanted) return;
  throw BadValue("variable " + io::in_quotes(variable.name) + " has " +
                 std::to_string(variable.num_values) + " values instead of " +
                 std::to_string(wanted));
}

bool has_units(const MeshVariable& variable, std::string_view standard_name,
               std::string_view direction) {
  if (io::netcdf_text(variable.attributes, "standard_name") == standard_name) return true;
  const std::string units = io::netcdf_text(variable.attributes, "units");
  return units.starts_with("degree") && units.ends_with(direction);
}

}  // namespace

std::vector<LonLat> positions_of(const io::NetcdfReader& file, const MeshVariable& lon,
                                 const MeshVariable& lat) {
  require_values(lat, lon.num_values);
  const std::vector<double> lons = file.degrees(lon);
  const std::vector<double> lats = file.degrees(lat);
  const std::string names = io::in_quotes(lon.name) + " and " + io::in_quotes(lat.name);
  std::vector<LonLat> positions(lons.size());
  for (std::size_t i = 0; i < lons.size(); ++i) {
    positions[i] = require_position(names, i, lons[i], lats[i]);
  }
  return positions;
}

LonLat require_position(const std::string& names, std::size_t i, double lon, double lat) {
  // pi / 2 in single precision is 90.0000025 degrees.
  constexpr double rounding = 1e-5;
  if (!std::isfinite(lon) || !(std::abs(lat) <= 90 + rounding)) {
    throw BadValue("value " + std::to_string(i) + " of " + names + ", " + std::to_string(lon) +
                   " and " + std::to_string(lat) + " degrees, is no place");
  }
  return {lon, std::clamp(lat, -90.0, 90.0)};
}

void take_nodes(const io::NetcdfReader& file, const MeshVariable& lon, const MeshVariable& lat,
                MeshContent& mesh) {
  mesh.nodes = positions_of(file, lon, lat);
  mesh.is_single = lon.type == io::NetcdfType::float32;
}

void take_corners(const io::NetcdfReader& file, const MeshVariable& lon, const MeshVariable& lat,
                  std::uint64_t num_cells, MeshContent& mesh) {
  if (num_cells == 0 || lon.num_values % num_cells != 0 || lon.num_values >= no_index) {
    throw BadValue("variable " + io::in_quotes(lon.name) + " has " +
                   std::to_string(lon.num_values) + " values for " + std::to_string(num_cells) +
                   " cells");
  }
  take_nodes(file, lon, lat, mesh);
  const std::uint64_t of_each = lon.num_values / num_cells;
  mesh.corners.reserve(lon.num_values);
  mesh.rings.reserve(num_cells + 1);
  mesh.cells.reserve(num_cells + 1);
  for (std::uint64_t i = 0; i < num_cells; ++i) {
    for (std::uint64_t k = 0; k < of_each; ++k) {
      mesh.corners.push_back(static_cast<Index>(i * of_each + k));
    }
    mesh.end_ring();
    mesh.end_cell();
  }
}

void take_connectivity(const io::NetcdfReader& file, const Connectivity& connectivity,
                       const std::vector<double>& counts, MeshContent& mesh) {
  const auto& [variable, num_cells, of_each, is_transposed, first, break_value] = connectivity;
  require_values(variable, num_cells * of_each);
  const std::vector<double> entries = file.numbers(variable);
  const double fill = number_or(variable, "_FillValue", std::nan(""));
  for (std::uint64_t i = 0; i < num_cells; ++i) {
    const double count = counts.empty() ? static_cast<double>(of_each) : counts[i];
    if (!(count >= 0 && count <= static_cast<double>(of_each))) {
      throw BadValue("cell " + std::to_string(i) + " has " + std::to_string(count) +
                     " corners of " + std::to_string(of_each));
    }
    for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(count); ++k) {
      const double entry = entries[is_transposed ? k * num_cells + i : i * of_each + k];
      if (break_value < first && entry == break_value) {
        mesh.end_ring();
        continue;
      }
      // What is not there is NaN, the fill value, or less than the first node.
      if (std::isnan(entry) || entry == fill || entry < first) continue;
      const double node = entry - first;
      if (!(node < static_cast<double>(mesh.nodes.size())) || node != std::floor(node)) {
        throw BadValue("cell " + std::to_string(i) + " has a corner " +
                       std::to_string(static_cast<std::int64_t>(entry)) + " of " +
                       std::to_string(mesh.nodes.size()) + " nodes");
      }
      mesh.corners.push_back(static_cast<Index>(node));
    }
    mesh.end_ring();
    mesh.end_cell();
  }
}

void take_mask(const io::NetcdfReader& file, std::string_view name, MeshContent& mesh) {
  const MeshVariable* const variable = file.find(name);
  if (variable == nullptr) return;
  require_values(*variable, mesh.cells.size() - 1);
  for (const double value : file.numbers(*variable)) mesh.mask.push_back(value == 0 ? 0 : 1);
  if (std::ranges::count(mesh.mask, 0) == 0) mesh.mask.clear();
}

void take_centers(const io::NetcdfReader& file, const MeshVariable* lon, const MeshVariable* lat,
                  MeshContent& mesh) {
  if (lon == nullptr || lat == nullptr) return;
  require_values(*lon, mesh.cells.size() - 1);
  mesh.centers = positions_of(file, *lon, *lat);
}

double number_or(const MeshVariable& variable, std::string_view name, double otherwise) {
  const io::NetcdfAttribute* const attribute = io::find_attribute(variable.attributes, name);
  return attribute == nullptr || attribute->numbers.empty() ? otherwise : attribute->numbers[0];
}

// degrees_east, degree_east, degree_E, degrees_E, degreeE, degreesE are the same to CF.
bool is_longitude(const MeshVariable& variable) {
  return has_units(variable, "longitude", "east") || has_units(variable, "longitude", "E");
}
bool is_latitude(const MeshVariable& variable) {
  return has_units(variable, "latitude", "north") || has_units(variable, "latitude", "N");
}

}  // namespace rondel::overlay
