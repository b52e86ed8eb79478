// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells are put into layers in which none overlap, as few as a first fit finds. Layer after layer is laid over those
// before, each filled up to a cover: every piece belongs to the least cell that it is of.
#include "overlay/first_of_cells.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondel/partition.h"

namespace rondel::overlay {
namespace {

// The layer of each cell.
std::vector<std::size_t> layers_of(std::size_t num_cells, std::span<const CrossingCells> overlaps) {
  std::vector<std::vector<Index>> earlier(num_cells);
  for (const CrossingCells& pair : overlaps) earlier[pair.second].push_back(pair.first);
  std::vector<std::size_t> layers(num_cells, 0);
  std::vector<std::size_t> taken;
  for (std::size_t c = 0; c < num_cells; ++c) {
    taken.clear();
    for (const Index other : earlier[c]) taken.push_back(layers[other]);
    while (std::ranges::find(taken, layers[c]) != taken.end()) ++layers[c];
  }
  return layers;
}

// Those of one layer; the others are empty.
CellRings cells_of_layer(const CellRings& cells, const std::vector<std::size_t>& layers,
                         std::size_t layer) {
  CellRings kept;
  kept.points = cells.points;
  for (std::size_t c = 0; c < cells.num_cells(); ++c) {
    if (layers[c] == layer) {
      if (cells.is_whole(c)) kept.whole.push_back(static_cast<Index>(c));
      for (std::uint64_t r = cells.cells[c]; r < cells.cells[c + 1]; ++r) {
        kept.corners.insert(
            kept.corners.end(), cells.corners.begin() + static_cast<std::ptrdiff_t>(cells.rings[r]),
            cells.corners.begin() + static_cast<std::ptrdiff_t>(cells.rings[r + 1]));
        kept.rings.push_back(kept.corners.size());
      }
    }
    kept.cells.push_back(kept.rings.size() - 1);
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
    cells.rings.push_back(cells.corners.size());
  }
  cells.points.insert(cells.points.end(), all.points.begin(), all.points.end());
  if (all.corners.empty() && !all.is_whole(0)) cells.whole.push_back(static_cast<Index>(n));
  cells.cells.push_back(cells.rings.size() - 1);
  return cells;
}

CellRings first_of_cells(const CellRings& cells, std::span<const CrossingCells> overlaps,
                         const Execution& execution) {
  if (overlaps.empty()) return cells;
  const std::size_t n = cells.num_cells();
  const std::vector<std::size_t> layers = layers_of(n, overlaps);
  const std::size_t num_layers = *std::ranges::max_element(layers) + 1;
  CellRings all = with_outside(cells_of_layer(cells, layers, 0), execution);
  for (std::size_t layer = 1; layer < num_layers; ++layer) {
    const CellRings next = with_outside(cells_of_layer(cells, layers, layer), execution);
    const RegionPieces pieces =
        intersection(Partition(all, execution), Partition(next, execution), execution);
    std::vector<Index> owners(pieces.num_pieces());
    for (std::size_t k = 0; k < owners.size(); ++k) {
      owners[k] = std::min(pieces.cells[k], pieces.regions[k]);
    }
    all = dissolve(pieces.rings, owners, n + 1, execution);
  }
  std::vector<Index> numbers(n + 1);
  for (std::size_t c = 0; c < n; ++c) numbers[c] = static_cast<Index>(c);
  numbers[n] = no_index;
  return dissolve(all, numbers, n, execution);
}

}  // namespace rondel::overlay
