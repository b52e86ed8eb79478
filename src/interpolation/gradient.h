// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Gradients at the vertices, as weights of the values around them (local_fit.h).
//
// in    a prepared triangulation, options
// out   one compressed row for each vertex
// index spatial ranks of vertices
#pragma once

#include <cstdint>
#include <vector>

#include "interpolation/prepared_triangulation.h"
#include "rondel/interpolate.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// Row v says that the gradient at vertex v, a tangent vector, is the sum of
// weights[k] f(vertices[k]).
// 1. The first entry is v itself, unless the row is empty; its weight is minus the sum of the
//    others in their order. So the sum of weights[k] (f(vertices[k]) - f(v)) over k > 0 is the more
//    accurate form.
// 2. A row is empty if the vertex has no gradient: its neighbors are too close, or they are in line
//    with it and Undetermined::missing is chosen.
struct GradientRows {
  std::vector<std::uint64_t> offsets = {0};
  std::vector<Index> vertices;
  std::vector<Point> weights;
};

// Computes the rows of all vertices. Precondition: dimension 2, Model::projected.
GradientRows gradient_rows(const PreparedTriangulation& prepared, const GradientOptions& options,
                           unsigned threads);

}  // namespace rondel::interpolation
