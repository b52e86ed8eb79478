// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the neighbors of targets: grid_neighbors(), place_neighbors(), target_neighbors().
#include <cmath>
#include <string>

#include "interpolation/grid_seam.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/extrapolate.h"
#include "rondel/query.h"
#include "system/job.h"

namespace rondel {
CompressedRows<Index> grid_neighbors(std::span<const Point> places, std::size_t rows,
                                     std::size_t columns) {
  const system::ArithmeticScope arithmetic;
  const bool fits = columns == 0 ? places.empty()
                                 : places.size() % columns == 0 && places.size() / columns == rows;
  if (!fits) {
    throw InvalidInput(std::to_string(places.size()) + " places are no grid of " +
                       std::to_string(rows) + " x " + std::to_string(columns));
  }
  const bool has_seam = interpolation::has_seam(places, rows, columns);
  CompressedRows<Index> neighbors;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const auto add = [&](std::size_t row, std::size_t column) {
        neighbors.values.push_back(static_cast<Index>(row * columns + column));
      };
      if (j > 0) add(j - 1, i);
      if (i > 0 || has_seam) add(j, i > 0 ? i - 1 : columns - 1);
      if (i + 1 < columns || has_seam) add(j, i + 1 < columns ? i + 1 : 0);
      if (j + 1 < rows) add(j + 1, i);
      neighbors.end_row();
    }
  }
  return neighbors;
}

CompressedRows<Index> place_neighbors(std::span<const Point> places, const Execution& execution) {
  const system::Call call(execution);
  std::vector<Index> numbers;
  std::vector<Point> known;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] == Point{0, 0, 0}) continue;
    numbers.push_back(static_cast<Index>(i));
    known.push_back(places[i]);
  }
  const Triangulation triangulation = delaunay(known, {}, execution);
  const Locator locator(triangulation);
  std::vector<std::vector<Index>> lists(places.size());
  for (std::size_t k = 0; k < known.size(); ++k) {
    for (const Index other : locator.neighbors(static_cast<Index>(k))) {
      lists[numbers[k]].push_back(numbers[other]);
    }
  }
  for (const auto& [site, representative] : triangulation.duplicates()) {
    lists[numbers[site]] = {numbers[representative]};
    lists[numbers[representative]].push_back(numbers[site]);
  }
  CompressedRows<Index> neighbors;
  for (const std::vector<Index>& list : lists) neighbors.append(list);
  return neighbors;
}

CompressedRows<Index> target_neighbors(std::span<const Point> places,
                                       std::span<const std::uint64_t> shape,
                                       const Execution& execution) {
  return shape.size() == 2 ? grid_neighbors(places, shape[0], shape[1])
                           : place_neighbors(places, execution);
}

std::vector<Point> known_unit_vectors(std::span<const LonLat> places) {
  const system::ArithmeticScope arithmetic;
  std::vector<Point> points;
  points.reserve(places.size());
  for (const LonLat& place : places) {
    const bool is_known = !std::isnan(place.lon_deg) && !std::isnan(place.lat_deg);
    points.push_back(is_known ? unit_vector(place) : Point{0, 0, 0});
  }
  return points;
}

}  // namespace rondel
