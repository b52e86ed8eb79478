// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Gradients where rows ask for them: as numbers of given fields, or as weights of their values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "interpolation/gradient.h"
#include "interpolation/ground.h"
#include "interpolation/place_values.h"
#include "interpolation/row.h"
#include "rondel/interpolate.h"
#include "rondel/weights.h"
#include "system/large_vector.h"

namespace rondel::interpolation {

// Whether each vertex has one; empty if all have.
std::vector<std::uint8_t> vertices_with(const GradientRows& rows);

// A gradient of a field at each site: three rows of it.
Weights gradient_weights(const Ground& ground, const GradientRows& rows, unsigned threads);

// Of each field at each vertex.
class PlaceGradients {
 public:
  // Estimated ones; those that cannot be had are zero. By their rows or, to the same bytes, without;
  // then `has_gradient` becomes what vertices_with() gives.
  PlaceGradients(const GradientRows& rows, const PlaceValues& values, unsigned threads);
  PlaceGradients(const Ground& ground, const GradientOptions& options, const PlaceValues& values,
                 unsigned threads, std::vector<std::uint8_t>& has_gradient);
  // Given ones, of one field after the other.
  PlaceGradients(const Ground& ground, std::span<const Point> given, SharedPlace shared,
                 unsigned threads);

  [[nodiscard]] const Point& operator()(std::size_t f, Index vertex) const {
    return by_vertex_[vertex * num_fields_ + f];
  }

 private:
  void take_means(const Ground& ground, std::span<const Point> given);

  std::size_t num_fields_;
  LargeVector<Point> by_vertex_;
};

// Turns rows with slopes into rows of values, in the order of the ranks. One for each thread.
class SlopeJoiner {
 public:
  // None: for rows without slopes.
  SlopeJoiner(const GradientRows* gradients, Normalization normalization)
      : gradients_(gradients), normalization_(normalization) {}
  // The result lives until the next call.
  const Row& operator()(const SlopeRow& row);

 private:
  void merge();

  const GradientRows* gradients_;
  Normalization normalization_;
  Row shares_;
  Row joined_;
};

}  // namespace rondel::interpolation
