// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Functions that the readers of all conventions share.
#include <algorithm>
#include <cmath>
#include <string>

#include "io/bad_value.h"
#include "io/cf_values.h"
#include "io/number.h"
#include "overlay/mesh_formats.h"
#include "system/shortest_text.h"

namespace rondel::overlay {
namespace {

using io::BadValue;

// Returns, for example, "3 of 17 cells".
std::string cells_in_words(std::size_t count, std::size_t of_all) {
  return std::to_string(count) + " of " + std::to_string(of_all) + " cells";
}

// True if the numbers are a place, up to rounding of single precision.
bool is_place(const LonLat& place) {
  // A latitude of pi / 2 in single precision is 90.0000025 degrees.
  constexpr double rounding = 1e-5;
  return std::isfinite(place.lon_deg) && std::abs(place.lat_deg) <= 90 + rounding;
}

// Returns the index of the node with this number in the file. Throws BadValue if there is no such
// node.
Index node_of(const Connectivity& connectivity, double number, std::size_t cell,
              std::size_t num_nodes, std::span<const double> entries) {
  const double node = number - connectivity.first;
  if (node < static_cast<double>(num_nodes) && node == std::floor(node)) {
    return static_cast<Index>(node);
  }
  const bool may_count_from_1 = connectivity.first == 0 && node == static_cast<double>(num_nodes) &&
                                std::ranges::count(entries, 0.0) == 0;
  throw BadValue(
      "cell " + std::to_string(cell) + " has a corner " +
      std::to_string(static_cast<std::int64_t>(number)) + " of " + std::to_string(num_nodes) +
      " nodes" +
      (may_count_from_1
           ? ", counted from 0; if they are counted from 1, the attribute start_index = 1 of " +
                 io::in_quotes(connectivity.variable.name) + " must say so"
           : std::string()));
}

}  // namespace

bool is_meant(const io::NetcdfReader& file, const std::string& name, const MeshVariable& cells) {
  const MeshVariable* const variable = file.find(name);
  return name.empty() ||
         (variable != nullptr && std::ranges::any_of(variable->dimensions, [&](std::size_t d) {
            return std::ranges::count(cells.dimensions, d) != 0;
          }));
}

void require_values(const MeshVariable& variable, std::uint64_t wanted) {
  if (variable.num_values == wanted) return;
  throw BadValue("variable " + io::in_quotes(variable.name) + " has " +
                 std::to_string(variable.num_values) + " values instead of " +
                 std::to_string(wanted));
}

const MeshVariable& require_rank(const MeshVariable& variable, std::size_t rank) {
  if (variable.shape.size() == rank) return variable;
  throw BadValue("variable " + io::in_quotes(variable.name) + " has " +
                 std::to_string(variable.shape.size()) + " dimensions instead of " +
                 std::to_string(rank));
}

bool is_missing_place(const LonLat& place) {
  return std::isnan(place.lon_deg) || std::isnan(place.lat_deg);
}

std::array<std::vector<double>, 2> degrees_of_both(const io::NetcdfReader& file,
                                                   const MeshCoordinates& wanted,
                                                   const MeshCoordinates& related,
                                                   UsualUnits usual) {
  return {io::degrees_of(file, *wanted.lon, usual, {related.lon, wanted.lat, related.lat}),
          io::degrees_of(file, *wanted.lat, usual, {related.lat, wanted.lon, related.lon})};
}

std::vector<LonLat> positions_of(const io::NetcdfReader& file, const MeshCoordinates& wanted,
                                 const MeshCoordinates& related, UsualUnits usual) {
  const MeshVariable& lon = *wanted.lon;
  const MeshVariable& lat = *wanted.lat;
  require_values(lat, lon.num_values);
  auto [lons, lats] = degrees_of_both(file, wanted, related, usual);
  if (lon.dimensions != lat.dimensions &&
      std::ranges::is_permutation(lon.dimensions, lat.dimensions)) {
    lats = io::in_order(lat, lon.dimensions, std::move(lats));
  }
  std::vector<LonLat> positions(lons.size());
  for (std::size_t i = 0; i < lons.size(); ++i) positions[i] = {lons[i], lats[i]};
  return positions;
}

LonLat require_position(const std::string& names, std::size_t i, const LonLat& place) {
  if (!is_place(place)) {
    throw BadValue("value " + std::to_string(i) + " of " + names + ", " +
                   system::shortest_text(place.lon_deg) + " and " +
                   system::shortest_text(place.lat_deg) + " degrees, is no place");
  }
  return {place.lon_deg, std::clamp(place.lat_deg, -90.0, 90.0)};
}

void take_nodes(const io::NetcdfReader& file, const MeshCoordinates& nodes,
                const MeshCoordinates& centers, UsualUnits usual, MeshContent& mesh) {
  mesh.nodes = positions_of(file, nodes, centers, usual);
  mesh.names = io::in_quotes(nodes.lon->name) + " and " + io::in_quotes(nodes.lat->name);
  mesh.is_single = nodes.lon->type == io::NetcdfType::float32;
}

void end_cells_of_nodes(std::size_t of_each, bool may_be_fewer, MeshContent& mesh) {
  const std::size_t num_cells = mesh.nodes.size() / of_each;
  mesh.corners.reserve(mesh.nodes.size());
  mesh.rings.reserve(num_cells + 1);
  mesh.cells.reserve(num_cells + 1);
  for (std::size_t i = 0; i < num_cells; ++i) {
    std::size_t count = of_each;
    while (may_be_fewer && count > 3 && is_missing_place(mesh.nodes[i * of_each + count - 1])) {
      --count;
    }
    for (std::size_t k = 0; k < count; ++k) {
      mesh.corners.push_back(static_cast<Index>(i * of_each + k));
    }
    mesh.end_ring();
    mesh.end_cell();
  }
}

void take_connectivity(const io::NetcdfReader& file, const Connectivity& connectivity,
                       const std::vector<double>& counts, MeshContent& mesh) {
  const auto& [variable, num_cells, of_each, is_transposed, first, break_value] = connectivity;
  const bool is_ragged = of_each == 0;
  if (!is_ragged) require_values(variable, num_cells * of_each);
  const std::vector<double> entries = file.numbers(variable);
  std::vector<double> meant = entries;
  io::ValueRules(variable).apply(meant);
  std::size_t num_undeclared = 0;
  std::uint64_t begin = 0;  // where the row of the cell begins
  for (std::uint64_t i = 0; i < num_cells; ++i) {
    const std::uint64_t most = is_ragged ? entries.size() - begin : of_each;
    const double given = counts.empty() ? static_cast<double>(of_each) : counts[i];
    if (!(given >= 0 && given <= static_cast<double>(most))) {
      throw BadValue("cell " + std::to_string(i) + " has " + system::shortest_text(given) +
                     " corners of " + std::to_string(most));
    }
    const auto count = static_cast<std::uint64_t>(given);
    const std::size_t num_before = num_undeclared;
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::uint64_t at = is_transposed ? k * num_cells + i : begin + k;
      if (break_value < first && entries[at] == break_value) {
        mesh.end_ring();
        continue;
      }
      if (std::isnan(meant[at]) || (entries[at] == 0 && first == 1)) continue;
      if (entries[at] < first) {
        ++num_undeclared;
        continue;
      }
      if (num_undeclared > num_before) {
        throw BadValue("cell " + std::to_string(i) + " has a corner less than " +
                       std::to_string(static_cast<std::int64_t>(first)) +
                       ", which no _FillValue of " + io::in_quotes(variable.name) +
                       " explains, before others");
      }
      mesh.corners.push_back(node_of(connectivity, entries[at], i, mesh.nodes.size(), entries));
    }
    mesh.end_ring();
    mesh.end_cell();
    begin += is_ragged ? count : of_each;
  }
  if (is_ragged) require_values(variable, begin);
  if (num_undeclared == 0) return;
  mesh.remarks.push_back(std::to_string(num_undeclared) + " numbers of " +
                         io::in_quotes(variable.name) + " are less than " +
                         std::to_string(static_cast<std::int64_t>(first)) +
                         " and taken for no corners, though there is no _FillValue");
}

void take_mask(const io::NetcdfReader& file, std::string_view name, MeshContent& mesh) {
  const MeshVariable* const variable = file.find(name);
  if (variable == nullptr) return;
  require_values(*variable, mesh.cells.size() - 1);
  for (const double value : io::meant_numbers(file, *variable)) {
    mesh.mask.push_back(value == 0 || std::isnan(value) ? 0 : 1);
  }
  const auto num_masked = static_cast<std::size_t>(std::ranges::count(mesh.mask, 0));
  if (num_masked == 0) {
    mesh.mask.clear();
  } else {
    mesh.remarks.push_back(cells_in_words(num_masked, mesh.mask.size()) + " are masked by " +
                           io::in_quotes(std::string(name)));
  }
}

void take_centers(const io::NetcdfReader& file, const MeshCoordinates& centers,
                  const MeshCoordinates& nodes, UsualUnits usual, MeshContent& mesh) {
  if (centers.lon == nullptr || centers.lat == nullptr) return;
  require_values(*centers.lon, mesh.cells.size() - 1);
  mesh.centers = positions_of(file, centers, nodes, usual);
}

void leave_out_cells_without_corners(MeshContent& mesh) {
  const std::size_t num_cells = mesh.cells.size() - 1;
  std::vector<std::int32_t> mask = mesh.mask;
  if (mask.empty()) mask.assign(num_cells, 1);
  std::vector<Index> corners;
  std::vector<std::uint64_t> rings = {0};
  std::vector<std::uint64_t> cells = {0};
  std::size_t num_left_out = 0;
  for (std::size_t i = 0; i < num_cells; ++i) {
    const std::uint64_t first = mesh.rings[mesh.cells[i]];
    const std::uint64_t last = mesh.rings[mesh.cells[i + 1]];
    bool is_whole = true;
    for (std::uint64_t k = first; k < last; ++k) {
      const Index node = mesh.corners[k];
      const bool may_be_no_place = mask[i] == 0 || is_missing_place(mesh.nodes[node]);
      if (!may_be_no_place) {
        (void)require_position(mesh.names, node, mesh.nodes[node]);
      }
      is_whole = is_whole && is_place(mesh.nodes[node]);
    }
    if (is_whole) {
      for (std::uint64_t r = mesh.cells[i]; r < mesh.cells[i + 1]; ++r) {
        corners.insert(corners.end(),
                       mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.rings[r]),
                       mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.rings[r + 1]));
        rings.push_back(corners.size());
      }
    } else {
      if (mask[i] != 0) ++num_left_out;
      mask[i] = 0;
    }
    cells.push_back(rings.size() - 1);
  }
  if (num_left_out > 0 && std::ranges::count(mask, 0) == std::ssize(mask)) {
    throw BadValue("no cell has corners: values of " + mesh.names + " are missing");
  }
  for (LonLat& node : mesh.nodes) {
    node =
        is_place(node) ? LonLat{node.lon_deg, std::clamp(node.lat_deg, -90.0, 90.0)} : LonLat{0, 0};
  }
  mesh.corners = std::move(corners);
  mesh.rings = std::move(rings);
  mesh.cells = std::move(cells);
  if (num_left_out == 0) return;
  mesh.mask = std::move(mask);
  mesh.remarks.push_back(cells_in_words(num_left_out, num_cells) +
                         " have corners that are missing and are left out");
}

double number_or(const MeshVariable& variable, std::string_view name, double otherwise) {
  const io::NetcdfAttribute* const attribute = io::find_attribute(variable.attributes, name);
  return attribute == nullptr || attribute->numbers.empty() ? otherwise : attribute->numbers[0];
}

}  // namespace rondel::overlay
