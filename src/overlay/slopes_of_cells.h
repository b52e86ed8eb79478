// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Gradients of fields that are given by means over cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/partition_data.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The gradient of cell i, by name, is the sum of slopes[k] (f[neighbors[k]] - f[i]) for its k.
struct CellGradients {
  std::vector<std::uint64_t> offsets = {0};
  std::vector<Index> neighbors;
  std::vector<Point> slopes;
};

// Least squares over the cells that share an edge, weighted by the inverse squares of distances, in the
// tangent plane of the center of mass; 0 along a direction that these do not determine. `centers` and `mask` by name; where there
// is a mask, cells of 0 are no neighbors.
CellGradients cell_gradients(const PartitionData& cells, std::span<const Point> centers,
                             std::span<const std::int32_t> mask, unsigned threads);

}  // namespace rondel::overlay
