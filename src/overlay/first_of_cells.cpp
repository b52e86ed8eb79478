// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Puts cells that overlap others into layers without overlaps; a first fit makes few layers. Each
// layer is completed to a cover by its outside and laid over the union of those before; each piece
// belongs to the lowest cell that has it. Where sides of two cells cross, each cell on either side
// overlaps one of the two or ends there, so other cells keep their corners.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "overlay/cell_set_data.h"
#include "overlay/disjoint_cells.h"
#include "overlay/overlaps.h"
#include "rondel/cell_set.h"
#include "system/distinct.h"

namespace rondel::overlay {
namespace {

constexpr std::size_t no_layer = static_cast<std::size_t>(-1);

// Returns the layer of each cell that overlaps another one, or no_layer. Cells of one layer are
// apart: where they overlapped by less than rounding, the border of their union could cross itself.
std::vector<std::size_t> layers_of(const CellRings& cells, std::span<const CrossingCells> overlaps,
                                   const Execution& execution) {
  const std::size_t num_cells = cells.num_cells();
  std::vector<std::size_t> layers(num_cells, no_layer);
  for (const CrossingCells& pair : overlaps) layers[pair.first] = layers[pair.second] = 0;
  const CellSet cell_set = CellSet::polygons(cells, execution);
  std::vector<std::vector<Index>> earlier(num_cells);
  for (const CrossingCells& pair : overlaps) earlier[pair.second].push_back(pair.first);
  for (const auto& [a, b] :
       near_cells(CellSetData::of(cell_set).subdivision(), execution.threads)) {
    if (layers[a] != no_layer && layers[b] != no_layer) earlier[b].push_back(a);
  }
  std::vector<std::size_t> taken;
  for (std::size_t c = 0; c < num_cells; ++c) {
    if (layers[c] == no_layer) continue;
    taken.clear();
    for (const Index other : earlier[c]) taken.push_back(layers[other]);
    while (std::ranges::find(taken, layers[c]) != taken.end()) ++layers[c];
  }
  return layers;
}

// Returns the cells of one layer; all other cells are empty.
CellRings cells_of_layer(const CellRings& cells, const std::vector<std::size_t>& layers,
                         std::size_t layer) {
  CellRings kept;
  kept.points = cells.points;
  for (std::size_t c = 0; c < cells.num_cells(); ++c) {
    if (layers[c] == layer) {
      kept.append_cell(cells, c);
    } else {
      kept.end_cell();
    }
  }
  return kept;
}

}  // namespace

CellRings with_outside(CellRings cells, const Execution& execution) {
  const std::size_t n = cells.num_cells();
  const CellRings all = dissolve(cells, std::vector<Index>(n, 0), 1, execution);
  for (std::size_t r = 0; r + 1 < all.rings.size(); ++r) {
    for (std::uint64_t k = all.rings[r + 1]; k-- > all.rings[r];) {
      cells.corners.push_back(static_cast<Index>(cells.points.size()) + all.corners[k]);
    }
    cells.end_ring();
  }
  cells.points.insert(cells.points.end(), all.points.begin(), all.points.end());
  if (all.corners.empty() && !all.is_whole(0)) cells.whole.push_back(static_cast<Index>(n));
  cells.end_cell();
  return cells;
}

CellRings first_of_cells(const CellRings& cells, std::span<const CrossingCells> overlaps,
                         const Execution& execution) {
  if (overlaps.empty()) return cells;
  const std::size_t n = cells.num_cells();
  const std::vector<std::size_t> layers = layers_of(cells, overlaps, execution);
  std::size_t num_layers = 1;
  for (const std::size_t layer : layers) {
    if (layer != no_layer) num_layers = std::max(num_layers, layer + 1);
  }
  CellRings all = with_outside(cells_of_layer(cells, layers, 0), execution);
  for (std::size_t layer = 1; layer < num_layers; ++layer) {
    const CellRings next = with_outside(cells_of_layer(cells, layers, layer), execution);
    const RegionPieces pieces = intersection(CellSetData::of_apart(all, execution),
                                             CellSetData::of_apart(next, execution), execution);
    std::vector<Index> owners(pieces.num_pieces());
    for (std::size_t k = 0; k < owners.size(); ++k) {
      owners[k] = std::min(pieces.cells[k], pieces.regions[k]);
    }
    all = dissolve(pieces.rings, owners, n + 1, execution);
  }
  CellRings result;
  result.points = cells.points;
  result.points.insert(result.points.end(), all.points.begin(), all.points.end());
  for (Index& corner : all.corners) corner += static_cast<Index>(cells.points.size());
  for (std::size_t c = 0; c < n; ++c) {
    result.append_cell(layers[c] == no_layer ? cells : all, c);
  }
  system::Distinct<Point> places = system::distinct<Point>(result.points);
  for (Index& corner : result.corners) corner = places.numbers[corner];
  result.points = std::move(places.values);
  return result;
}

}  // namespace rondel::overlay
