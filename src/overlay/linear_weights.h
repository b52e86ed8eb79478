// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the weights of conservative remapping of order 2.
//
// in    the pieces of a remapping with their moments, and gradients at its sources
// out   a matrix of weights
// index rows: targets; columns: sources; both by their indices in the input
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/cell_set_data.h"
#include "rondel/remap.h"
#include "rondel/types.h"
#include "rondel/weights.h"

namespace rondel::overlay {

// The gradients of fields that are given as means over cells, as rows of vectors. Indices are those
// of the cells in the input.
// The gradient of cell i is the sum of slopes[k] (f[neighbors[k]] - f[i]) over k from offsets[i] to
// offsets[i + 1] - 1, for means f.
struct CellGradients {
  std::vector<std::uint64_t> offsets = {0};
  std::vector<Index> neighbors;
  std::vector<Point> slopes;
};

// Returns the mean of each region, not on the sphere, from its area and its moment; 0 without an area.
std::vector<Point> means_of(std::span<const double> areas, std::span<const Point> moments);

// Returns the least squares gradients over the neighbors of each cell that share an edge with it,
// weighted by the inverse squares of distances, in the tangent plane of the cell's center of mass.
// The gradient is 0 along a direction that the neighbors do not determine. `centers` are centers of
// mass. Masked cells (0) are no neighbors; an empty mask masks no cell.
CellGradients cell_gradients(const CellSetData& cells, std::span<const Point> centers,
                             std::span<const std::int32_t> mask, unsigned threads);

// Returns the moments of the pieces of a remapping around the means of their sources. `moments` are
// those around the center of the sphere.
std::vector<Point> moments_around(const std::vector<Point>& means, const Remap& remap,
                                  std::vector<Point> moments);

// Returns the weights of a remapping with moments, divided by `target_areas`. `gradients` belong to
// the sources. `targets` lists the indices of the targets in the spatial order in which their rows
// are computed; if it is empty, this is the order of the input. The result does not depend on it.
Weights linear_weights(const Remap& remap, const CellGradients& gradients,
                       std::span<const double> target_areas, std::span<const Index> targets,
                       unsigned threads);

}  // namespace rondel::overlay
