// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Compares cells with their centers: which way round the nodes of a grid are, and which centers are
// outside of their cells.
//
// A cell that is smaller than a hemisphere lies in the cap around its middle (the mean of its
// corners) through the farthest corner, since caps are convex. A center outside of this cap is
// outside of the cell, whatever the cell's shape is.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/read_cells.h"
#include "system/arithmetic.h"

namespace rondel {
namespace {

bool is_center(const LonLat& place) {
  return std::isfinite(place.lon_deg) && std::abs(place.lat_deg) <= 90;
}

// True for the numbers that files have where there is land.
bool is_zero(const LonLat& place) { return place.lon_deg == 0 && place.lat_deg == 0; }

double squared_chord(const Point& a, const Point& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z);
}

// Returns the unit vector of a sum, or the origin if the points cancel.
Point middle_of(const Point& sum) {
  const double length = std::sqrt(squared_chord(sum, {0, 0, 0}));
  constexpr double none = 1e-9;
  if (!(length > none)) return {0, 0, 0};
  return {sum.x / length, sum.y / length, sum.z / length};
}

// The squared radius in chords of the cap around `middle` through the farthest corner; a little
// more, by the rounding of coordinates in single precision.
class Cap {
 public:
  void add(const Point& corner) {
    sum_ = {sum_.x + corner.x, sum_.y + corner.y, sum_.z + corner.z};
  }
  void end() { middle_ = middle_of(sum_); }
  void reach(const Point& corner) { squared_ = std::max(squared_, squared_chord(corner, middle_)); }
  // False for caps that are not smaller than a hemisphere, about which nothing is known.
  [[nodiscard]] bool is_outside(const Point& center) const {
    constexpr double rounding = 2e-6;  // 1e-4 degrees
    constexpr double hemisphere = 2;
    const double radius = std::sqrt(squared_) * (1 + 1e-6) + rounding;
    return squared_ < hemisphere && squared_chord(center, middle_) > radius * radius;
  }

 private:
  Point sum_ = {0, 0, 0};
  Point middle_ = {0, 0, 0};
  double squared_ = 0;
};

// Returns the corners of the cells of grids whose nodes are `column` apart along a row of cells,
// and `row` along a column.
std::vector<LonLat> corners_between(std::span<const LonLat> nodes, std::size_t of_one,
                                    const GridShape& shape, std::size_t row, std::size_t column) {
  std::vector<LonLat> corners;
  corners.reserve(4 * nodes.size());
  for (std::size_t first = 0; first < nodes.size(); first += of_one) {
    for (std::size_t j = 0; j < shape.rows; ++j) {
      for (std::size_t i = 0; i < shape.columns; ++i) {
        const std::size_t at = first + j * row + i * column;
        for (const std::size_t k : {at, at + column, at + row + column, at + row}) {
          corners.push_back(nodes[k]);
        }
      }
    }
  }
  return corners;
}

// Returns the sum of the squared distances of centers, except for zeros, from the middles of four
// corners.
double distance_of(std::span<const LonLat> centers, std::span<const LonLat> corners) {
  double sum = 0;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const auto four = corners.subspan(4 * i, 4);
    if (!is_center(centers[i]) || is_zero(centers[i]) || !std::ranges::all_of(four, is_center))
      continue;
    Point total = {0, 0, 0};
    for (const LonLat& corner : four) {
      const Point at = unit_vector(corner);
      total = {total.x + at.x, total.y + at.y, total.z + at.z};
    }
    sum += squared_chord(unit_vector(centers[i]), middle_of(total));
  }
  return sum;
}

}  // namespace

std::vector<LonLat> corners_of_grid(std::span<const LonLat> nodes, GridShape node_shape,
                                    std::span<const LonLat> centers, GridShape shape) {
  const system::ArithmeticScope arithmetic;
  const std::size_t of_one = node_shape.rows * node_shape.columns;
  const bool fits = node_shape.rows == shape.rows + 1 && node_shape.columns == shape.columns + 1;
  const bool fits_turned =
      node_shape.rows == shape.columns + 1 && node_shape.columns == shape.rows + 1;
  if (!(fits || fits_turned) || of_one == 0 || nodes.size() % of_one != 0 ||
      centers.size() != nodes.size() / of_one * shape.rows * shape.columns) {
    throw InvalidInput(std::to_string(nodes.size()) + " nodes are no corners of " +
                       std::to_string(centers.size()) + " cells");
  }
  std::vector<LonLat> corners;
  if (fits) corners = corners_between(nodes, of_one, shape, node_shape.columns, 1);
  if (!fits_turned) return corners;
  std::vector<LonLat> turned = corners_between(nodes, of_one, shape, 1, node_shape.columns);
  const bool is_turned = !fits || distance_of(centers, turned) < distance_of(centers, corners);
  return is_turned ? turned : corners;
}

CentersOutside centers_outside(const CellRings& cells, std::span<const LonLat> centers,
                               std::span<const std::int32_t> mask) {
  const system::ArithmeticScope arithmetic;
  if (centers.size() != cells.num_cells() || (!mask.empty() && mask.size() != centers.size())) {
    throw InvalidInput("there are " + std::to_string(centers.size()) + " centers and " +
                       std::to_string(mask.size()) + " numbers of a mask for " +
                       std::to_string(cells.num_cells()) + " cells");
  }
  CentersOutside found;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const bool is_masked = !mask.empty() && mask[i] == 0;
    if (is_masked || cells.cells[i] == cells.cells[i + 1] || !is_center(centers[i])) continue;
    const auto corners = std::span(cells.corners)
                             .subspan(cells.rings[cells.cells[i]], cells.rings[cells.cells[i + 1]] -
                                                                       cells.rings[cells.cells[i]]);
    Cap cap;
    for (const Index corner : corners) cap.add(cells.points[corner]);
    cap.end();
    for (const Index corner : corners) cap.reach(cells.points[corner]);
    ++found.of;
    if (!cap.is_outside(unit_vector(centers[i]))) continue;
    if (found.number++ == 0) found.first = i;
    if (is_zero(centers[i])) ++found.zeros;
  }
  return found;
}

}  // namespace rondel
