// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Describes sets of cells as files of weights do.
#include <algorithm>
#include <cstddef>
#include <span>

#include "overlay/cell_set_data.h"
#include "rondel/delaunay.h"
#include "rondel/mesh_files.h"
#include "system/arithmetic.h"

namespace rondel {
namespace {

// Cells with more corners are written without corners.
constexpr std::size_t most_weight_corners = 16;

// Returns four corners for each cell of a grid.
std::vector<LonLat> corners_of_graticule(const overlay::Graticule& grid) {
  std::vector<LonLat> corners(4 * static_cast<std::size_t>(grid.num_cells()));
  for (Index column = 0; column < grid.num_columns_of_grid(); ++column) {
    const overlay::Graticule::Lune& lune = grid.columns()[column];
    for (Index row = 0; row < grid.num_rows_of_grid(); ++row) {
      const double south = grid.latitudes()[row];
      const double north = grid.latitudes()[row + std::size_t{1}];
      const std::size_t first =
          4 * static_cast<std::size_t>(grid.cell(column, grid.first_row() + row));
      corners[first] = {lune.west_deg, south};
      corners[first + 1] = {lune.east_deg, south};
      corners[first + 2] = {lune.east_deg, north};
      corners[first + 3] = {lune.west_deg, north};
    }
  }
  return corners;
}

}  // namespace

std::vector<LonLat> weight_corners(const CellSet& partition) {
  const system::ArithmeticScope arithmetic;
  const overlay::CellSetData& data = overlay::CellSetData::of(partition);
  if (data.grid() != nullptr) return corners_of_graticule(*data.grid());
  const CellRings cells = partition.rings();
  std::size_t most = 0;
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    const std::uint64_t ring = cells.cells[i];
    if (cells.cells[i + 1] == ring) continue;
    if (cells.cells[i + 1] != ring + 1) return {};
    most = std::max<std::size_t>(most, cells.rings[ring + 1] - cells.rings[ring]);
  }
  if (most > most_weight_corners) return {};
  const std::vector<LonLat> places = lonlats(cells.points);
  std::vector<LonLat> corners;
  corners.reserve(cells.num_cells() * most);
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    const std::uint64_t first = cells.cells[i];
    if (cells.cells[i + 1] == first) {
      corners.insert(corners.end(), most, LonLat{0, 0});
      continue;
    }
    const std::span<const Index> ring =
        std::span(cells.corners)
            .subspan(cells.rings[first], cells.rings[first + 1] - cells.rings[first]);
    for (std::size_t k = 0; k < most; ++k) {
      corners.push_back(places[ring[std::min(k, ring.size() - 1)]]);
    }
  }
  return corners;
}

WeightSide weight_side(const CellTable& table, const CellSet& partition) {
  const system::ArithmeticScope arithmetic;
  WeightSide side;
  side.points = table.centers.empty() ? lonlats(partition.centers()) : table.centers;
  side.mask = table.mask;
  side.shape = table.shape;
  side.corners = weight_corners(partition);
  return side;
}

}  // namespace rondel
