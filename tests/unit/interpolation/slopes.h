// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Targets, and sums over the rows of methods with gradients.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "exact/unit_vector.h"
#include "interpolation/gradient.h"
#include "interpolation/prepared_triangulation.h"
#include "interpolation/row.h"
#include "support/generators.h"

namespace rondel::test {

inline Point unit_point(const interpolation::PreparedTriangulation& prepared, Index v) {
  return exact::to_point(exact::to_vector(prepared.unit(v).hi));
}

inline interpolation::LocatedTarget place_of(const interpolation::PreparedTriangulation& prepared,
                                             const Point& p) {
  query::Cursor cursor;
  cursor.vertex = prepared.near(p);
  return {p, exact::unit_vector(p, prepared.center()), prepared.engine().locate(p, cursor)};
}

// Those of `count` random points over random solid faces that lie in a face or on an edge.
inline std::vector<interpolation::LocatedTarget> places_in_faces(
    const interpolation::PreparedTriangulation& prepared, std::size_t count, Random& random) {
  std::vector<interpolation::LocatedTarget> places;
  const auto& mesh = prepared.mesh();
  for (std::size_t i = 0; i < count; ++i) {
    const Index f = static_cast<Index>(random.below(mesh.num_slots()));
    if (!prepared.is_solid(f)) continue;
    Point p{};
    double rest = 1;
    for (unsigned k = 0; k < 3; ++k) {
      const double part = k < 2 ? rest * random.unit() : rest;
      rest -= part;
      p = p + part * unit_point(prepared, mesh[f].vertex[k]);
    }
    const interpolation::LocatedTarget place = place_of(prepared, prepared.center() + p);
    if (place.location.where == Where::face || place.location.where == Where::edge) {
      places.push_back(place);
    }
  }
  return places;
}

inline double sum_of(const interpolation::GradientRow& row, const std::vector<double>& values,
                     const std::vector<Point>& gradients) {
  double sum = 0;
  for (const auto& [v, weight, slope] : row) {
    sum += weight * values[v] + dot(slope, gradients[v]);
  }
  return sum;
}

inline std::vector<Point> gradients_of(const interpolation::GradientRows& rows,
                                       const std::vector<double>& values) {
  std::vector<Point> gradients;
  for (Index v = 0; v < values.size(); ++v) {
    Point sum{};
    for (std::uint64_t k = rows.offsets[v]; k < rows.offsets[v + 1]; ++k) {
      sum = sum + (values[rows.vertices[k]] - values[v]) * rows.weights[k];
    }
    gradients.push_back(sum);
  }
  return gradients;
}

inline double sum_of_weights(const interpolation::GradientRow& row) {
  double sum = 0;
  for (const auto& share : row) sum += share.weight;
  return sum;
}

inline double largest_weight(const interpolation::GradientRow& row) {
  double largest = 0;
  for (const auto& share : row) largest = std::max(largest, std::abs(share.weight));
  return largest;
}

}  // namespace rondel::test
