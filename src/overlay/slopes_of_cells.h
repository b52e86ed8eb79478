// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Estimates the gradients of fields that are given as means over cells.
//
// in    cells, their centers and a mask
// out   rows of vectors, whose products with differences of means are gradients
// index indices of the cells in the input
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/cell_set_data.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The gradient of cell i is the sum of slopes[k] (f[neighbors[k]] - f[i]) over k from offsets[i] to
// offsets[i + 1] - 1, for means f.
struct CellGradients {
  std::vector<std::uint64_t> offsets = {0};
  std::vector<Index> neighbors;
  std::vector<Point> slopes;
};

// Returns the least squares gradients over the neighbors of each cell that share an edge with it,
// weighted by the inverse squares of distances, in the tangent plane of the cell's center of mass.
// The gradient is 0 along a direction that the neighbors do not determine. `centers` are centers of
// mass. Masked cells (0) are no neighbors; an empty mask masks no cell.
CellGradients cell_gradients(const CellSetData& cells, std::span<const Point> centers,
                             std::span<const std::int32_t> mask, unsigned threads);

}  // namespace rondel::overlay
