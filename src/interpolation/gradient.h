// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Gradients at the vertices, as weights of the values around them (local_fit.h).
#pragma once

#include <cstdint>
#include <vector>

#include "interpolation/ground.h"
#include "rondel/interpolate.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// Row v: the gradient at vertex v is the sum of weights[k] f(vertices[k]), a tangent vector.
// 1. v itself comes first, if there is anything; its weight is minus the sum of the others in their
//    order, so that the sum of weights[k] (f(vertices[k]) - f(v)), k > 0, is the better way to take it.
// 2. A row without entries: all neighbors of v are in line with it.
struct GradientRows {
  std::vector<std::uint64_t> offsets = {0};
  std::vector<Index> vertices;
  std::vector<Point> weights;
};

// Precondition: dimension 2, Model::projected.
GradientRows gradient_rows(const Ground& ground, const GradientOptions& options, unsigned threads);

}  // namespace rondel::interpolation
