// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Gradients for the rows that need them: as vectors for given fields, or as weights of values.
//
// in    rows of gradients at vertices (gradient.h), or given gradients by site
// out   gradients by vertex; rows of weights of values alone
// index vertices by spatial rank; sites in Weights
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "interpolation/gradient.h"
#include "interpolation/prepared_triangulation.h"
#include "interpolation/row.h"
#include "interpolation/vertex_fields.h"
#include "rondel/interpolate.h"
#include "rondel/weights.h"
#include "system/large_arrays.h"

namespace rondel::interpolation {

// Returns for each vertex 1 if it has a gradient, or an empty vector if all have one.
std::vector<std::uint8_t> vertices_with(const GradientRows& rows);

// Returns the weights of the gradient at each site: three rows (x, y, z) a site.
Weights gradient_weights(const PreparedTriangulation& prepared, const GradientRows& rows,
                         unsigned threads);

// The gradient of each field at each vertex.
class VertexGradients {
 public:
  // Estimates the gradients; where there is none, it is zero. The second constructor has the same
  // results without storing rows, and sets `has_gradient` to what vertices_with() returns.
  VertexGradients(const GradientRows& rows, const VertexFields& values, unsigned threads);
  VertexGradients(const PreparedTriangulation& prepared, const GradientOptions& options,
                  const VertexFields& values, unsigned threads,
                  std::vector<std::uint8_t>& has_gradient);
  // Takes gradients that are given by site, one field after the other.
  VertexGradients(const PreparedTriangulation& prepared, std::span<const Point> given,
                  SharedPlace shared, unsigned threads);

  [[nodiscard]] const Point& operator()(std::size_t f, Index vertex) const {
    return by_vertex_[vertex * num_fields_ + f];
  }

 private:
  void take_means(const PreparedTriangulation& prepared, std::span<const Point> given);

  std::size_t num_fields_;
  LargeVector<Point> by_vertex_;
};

// Replaces the gradients in rows by their weights of values; the entries come in the order of
// ranks. Each thread has its own.
class GradientJoiner {
 public:
  // `gradients` is null for rows without gradients.
  GradientJoiner(const GradientRows* gradients, Normalization normalization)
      : gradients_(gradients), normalization_(normalization) {}
  // The result is valid until the next call.
  const Row& operator()(const GradientRow& row);

 private:
  void merge();

  const GradientRows* gradients_;
  Normalization normalization_;
  Row shares_;
  Row joined_;
};

}  // namespace rondel::interpolation
