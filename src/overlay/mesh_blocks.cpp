// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Readers of cells of coupled models and of finite elements:
//
// 1. OASIS: grids.nc, with several grids in one file, told apart by the first parts of variable
//    names (OASIS3-MCT user guide, section 5.1)
// 2. Exodus II: blocks of elements with the same number of corners, at points in space (Schoof and
//    Yarberry, SAND92-2137)
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "io/bad_value.h"
#include "io/cf_reader.h"
#include "io/number.h"
#include "overlay/mesh_formats.h"
#include "rondel/weight_files.h"

namespace rondel::overlay {
namespace {

using io::BadValue;
using io::NetcdfReader;

// Returns the names of the grids that have corners: "bt42" for variables bt42.clo and bt42.cla.
std::vector<std::string> oasis_grids(const NetcdfReader& file) {
  std::vector<std::string> names;
  for (const MeshVariable& variable : file.variables()) {
    if (!variable.name.ends_with(".clo")) continue;
    const std::string name = variable.name.substr(0, variable.name.size() - 4);
    if (file.find(name + ".cla") != nullptr) names.push_back(name);
  }
  return names;
}

// Returns which dimension counts the corners of a cell: the one that the centers do not have, or
// else the last one.
std::size_t corner_dimension(const MeshVariable& corners, const MeshVariable* centers) {
  for (std::size_t d = 0; centers != nullptr && d < corners.dimensions.size(); ++d) {
    if (std::ranges::count(centers->dimensions, corners.dimensions[d]) == 0) return d;
  }
  return corners.dimensions.size() - 1;
}

// Returns positions with the corners of each cell one after the other. `corner` is the dimension
// that counts corners.
std::vector<LonLat> corners_last(const MeshVariable& variable, std::size_t corner,
                                 const std::vector<double>& lon, const std::vector<double>& lat) {
  std::vector<std::size_t> order;
  for (std::size_t d = 0; d < variable.shape.size(); ++d) {
    if (d != corner) order.push_back(d);
  }
  order.push_back(corner);
  const std::vector<double> lons = io::transposed(variable.shape, order, lon);
  const std::vector<double> lats = io::transposed(variable.shape, order, lat);
  std::vector<LonLat> positions(lons.size());
  for (std::size_t i = 0; i < lons.size(); ++i) positions[i] = {lons[i], lats[i]};
  return positions;
}

// Returns the nodes, which are points in space.
std::vector<Point> points_of_exodus(const NetcdfReader& file) {
  std::vector<Point> points;
  if (const MeshVariable* const all = file.find("coord")) {
    if (require_rank(*all, 2).shape[0] != 3) {
      throw BadValue(R"(variable "coord" has not three coordinates)");
    }
    const std::vector<double> values = io::meant_numbers(file, *all);
    const std::size_t n = values.size() / 3;
    for (std::size_t i = 0; i < n; ++i) {
      points.push_back({values[i], values[n + i], values[2 * n + i]});
    }
    return points;
  }
  const std::vector<double> x = io::meant_numbers(file, file.require("coordx"));
  const std::vector<double> y = io::meant_numbers(file, file.require("coordy"));
  const std::vector<double> z = io::meant_numbers(file, file.require("coordz"));
  if (x.size() != y.size() || x.size() != z.size()) {
    throw BadValue(R"(variables "coordx", "coordy" and "coordz" have not as many values)");
  }
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], y[i], z[i]});
  return points;
}

// Returns the elements' numbers, block by block, from the variables `global_id1`, `global_id2` ...
// that TempestRemap writes. The result is empty if a block has no such variable.
std::vector<double> ids_of_blocks(const NetcdfReader& file, std::size_t num_blocks) {
  std::vector<double> ids;
  for (std::size_t block = 1; block <= num_blocks; ++block) {
    const MeshVariable* const of_block = file.find("global_id" + std::to_string(block));
    if (of_block == nullptr) return {};
    const std::vector<double> numbers = file.numbers(*of_block);
    ids.insert(ids.end(), numbers.begin(), numbers.end());
  }
  return ids;
}

// Returns the place of each number 1 to n among `numbers`, or nothing if they are not these
// numbers, each once.
std::vector<std::size_t> places_of_numbers(const std::vector<double>& numbers, std::size_t n) {
  std::vector<std::size_t> places(n, n);
  if (numbers.size() != n) return {};
  for (std::size_t k = 0; k < n; ++k) {
    const double number = numbers[k];
    if (!(number >= 1 && number <= static_cast<double>(n)) || number != std::floor(number))
      return {};
    std::size_t& place = places[static_cast<std::size_t>(number) - 1];
    if (place != n) return {};
    place = k;
  }
  return places;
}

// Puts the cells into the order of their numbers. The blocks have them sorted by their number of
// corners.
void order_by_number(const NetcdfReader& file, std::size_t num_blocks, MeshContent& mesh) {
  const std::size_t n = mesh.cells.size() - 1;
  const MeshVariable* const map = file.find("elem_num_map");
  std::vector<std::size_t> places;
  if (map != nullptr) places = places_of_numbers(file.numbers(*map), n);
  if (places.empty()) places = places_of_numbers(ids_of_blocks(file, num_blocks), n);
  if (places.empty()) {
    if (map == nullptr) return;
    mesh.remarks.push_back("the numbers of " + io::in_quotes(map->name) + " are not 1 to " +
                           std::to_string(n) + ", each once: cells are in the order of the blocks");
    return;
  }
  MeshContent ordered;
  for (const std::size_t place : places) {
    for (std::uint64_t ring = mesh.cells[place]; ring < mesh.cells[place + 1]; ++ring) {
      for (std::uint64_t k = mesh.rings[ring]; k < mesh.rings[ring + 1]; ++k) {
        ordered.corners.push_back(mesh.corners[k]);
      }
      ordered.end_ring();
    }
    ordered.end_cell();
  }
  mesh.corners = std::move(ordered.corners);
  mesh.rings = std::move(ordered.rings);
  mesh.cells = std::move(ordered.cells);
}

}  // namespace

std::optional<MeshContent> read_oasis(const NetcdfReader& file, const std::string& name) {
  const std::vector<std::string> grids = oasis_grids(file);
  if (grids.empty()) return std::nullopt;
  const auto chosen = std::ranges::find_if(grids, [&](const std::string& grid) {
    return name.empty() || name == grid || name.starts_with(grid + '.');
  });
  if (chosen == grids.end()) return std::nullopt;
  MeshContent mesh;
  mesh.convention = "OASIS";
  if (name.empty() && grids.size() > 1) {
    std::string others;
    for (const std::string& grid : grids) {
      if (grid != *chosen) others += (others.empty() ? "" : ", ") + grid;
    }
    mesh.remarks.push_back("the file has several grids; " + *chosen + " is read, not " + others +
                           "; FILE.nc:NAME names one");
  }
  const MeshVariable& lon = file.require(*chosen + ".clo");
  const MeshVariable& lat = file.require(*chosen + ".cla");
  const MeshCoordinates centers = {file.find(*chosen + ".lon"), file.find(*chosen + ".lat")};
  if (lon.shape.size() < 2 || lon.shape != lat.shape || lon.num_values >= no_index) {
    throw BadValue("variables " + io::in_quotes(lon.name) + " and " + io::in_quotes(lat.name) +
                   " are no corners of cells");
  }
  const std::size_t corner = corner_dimension(lon, centers.lon);
  const auto [lons, lats] = degrees_of_both(file, {&lon, &lat}, centers, UsualUnits::degrees);
  mesh.nodes = corners_last(lon, corner, lons, lats);
  mesh.names = io::in_quotes(lon.name) + " and " + io::in_quotes(lat.name);
  mesh.is_single = lon.type == io::NetcdfType::float32;
  if (mesh.nodes.empty()) throw BadValue("grid " + *chosen + " has no cells");
  for (std::size_t d = 0; d < lon.shape.size() && lon.shape.size() > 2; ++d) {
    if (d != corner) mesh.shape.push_back(lon.shape[d]);
  }
  end_cells_of_nodes(lon.shape[corner], !has_rows(mesh.shape), mesh);
  take_mask(file, *chosen + ".msk", mesh.cells.size() - 1, MaskedBy::others, mesh);
  take_centers(file, centers, {&lon, &lat}, UsualUnits::degrees, mesh);
  return mesh;
}

std::optional<MeshContent> read_exodus(const NetcdfReader& file, const std::string& name) {
  const MeshVariable* const block_1 = file.find("connect1");
  if (block_1 == nullptr || !is_meant(file, name, *block_1)) return std::nullopt;
  MeshContent mesh;
  mesh.convention = "Exodus";
  mesh.nodes = lonlats(points_of_exodus(file));
  mesh.names = "the coordinates";
  std::size_t num_along_parallels = 0;
  std::size_t num_blocks = 0;
  while (const MeshVariable* const corners =
             file.find("connect" + std::to_string(num_blocks + 1))) {
    const std::size_t block = ++num_blocks;
    const auto& shape = require_rank(*corners, 2).shape;
    take_connectivity(file, {*corners, shape[0], shape[1], false, 1, 1}, {}, mesh);
    if (const MeshVariable* const kinds = file.find("edge_type" + std::to_string(block))) {
      for (const double kind : file.numbers(*kinds)) num_along_parallels += kind == 1 ? 1U : 0U;
    }
  }
  order_by_number(file, num_blocks, mesh);
  if (num_along_parallels > 0) {
    mesh.remarks.push_back(std::to_string(num_along_parallels) +
                           " sides along parallels (edge_type) are taken for great circles");
  }
  return mesh;
}

}  // namespace rondel::overlay
