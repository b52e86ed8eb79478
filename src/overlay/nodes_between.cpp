// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes the nodes of a grid that has centers alone: nodes_between().
//
// in    centers row by row, with gaps
// out   nodes, one row and one column more
// index places in a frame of one more place on each side: (row + 1) * (columns + 2) + column + 1
//
// Gaps and the frame are filled by mirror images, in two rounds: the second one reaches the corners
// of the frame, and gaps whose neighbors are gaps.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "exact/vector.h"
#include "interpolation/grid_seam.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/read_cells.h"
#include "system/arithmetic.h"

namespace rondel {
namespace {

constexpr Point unknown{0, 0, 0};

class FramedCenters {
 public:
  FramedCenters(std::span<const LonLat> centers, GridShape shape)
      : rows_(shape.rows), columns_(shape.columns), width_(shape.columns + 2) {
    std::vector<Point> points;
    for (const LonLat& center : centers) {
      const bool is_place = std::isfinite(center.lon_deg) && std::abs(center.lat_deg) <= 90;
      points.push_back(is_place ? unit_vector(center) : unknown);
    }
    goes_around_ = interpolation::has_seam(points, rows_, columns_);
    places_.assign((rows_ + 2) * width_, unknown);
    for (std::size_t j = 0; j < rows_; ++j) {
      for (std::size_t i = 0; i < columns_; ++i) {
        places_[(j + 1) * width_ + i + 1] = points[j * columns_ + i];
      }
    }
    for (int round = 0; round < 2; ++round) fill();
  }

  // Returns the node before a row and before a column of centers, or NaN.
  [[nodiscard]] LonLat node(std::size_t row, std::size_t column) const {
    Point sum{0, 0, 0};
    for (const std::size_t j : {row, row + 1}) {
      for (const std::size_t i : {column, column + 1}) {
        const Point& place = places_[j * width_ + i];
        if (place == unknown) return no_node;
        sum = sum + place;
      }
    }
    if (!(dot(sum, sum) > 0)) return no_node;
    const Point middle = normalized(sum);
    return lonlats({&middle, 1}).front();
  }

 private:
  static constexpr LonLat no_node = {std::numeric_limits<double>::quiet_NaN(),
                                     std::numeric_limits<double>::quiet_NaN()};

  // Adds the mirror image for a place of the frame, of the place two steps away in the next one.
  void add_image(std::size_t at, std::ptrdiff_t step, std::size_t steps_left, Point& sum) const {
    if (steps_left < 2) return;
    const auto place = [&](std::ptrdiff_t k) -> const Point& {
      return places_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) + k * step)];
    };
    const Point& a = place(1);
    const Point& b = place(2);
    if (a == unknown || b == unknown) return;
    sum = sum + (2 * dot(a, b) * a - b);
  }

  // Fills each place that is unknown from those that were known before.
  void fill() {
    std::vector<Point> filled = places_;
    const auto along_row = std::ptrdiff_t{1};
    const auto along_column = static_cast<std::ptrdiff_t>(width_);
    for (std::size_t j = 0; j < rows_ + 2; ++j) {
      for (std::size_t i = 0; i < width_; ++i) {
        const std::size_t at = j * width_ + i;
        if (places_[at] != unknown) continue;
        Point sum{0, 0, 0};
        add_image(at, along_row, width_ - 1 - i, sum);
        add_image(at, -along_row, i, sum);
        add_image(at, along_column, rows_ + 1 - j, sum);
        add_image(at, -along_column, j, sum);
        if (dot(sum, sum) > 0) filled[at] = normalized(sum);
      }
    }
    places_ = std::move(filled);
    if (!goes_around_) return;
    for (std::size_t j = 0; j < rows_ + 2; ++j) {
      places_[j * width_] = places_[j * width_ + columns_];
      places_[j * width_ + columns_ + 1] = places_[j * width_ + 1];
    }
  }

  std::size_t rows_;
  std::size_t columns_;
  std::size_t width_;
  bool goes_around_ = false;
  std::vector<Point> places_;
};

}  // namespace

std::vector<LonLat> nodes_between(std::span<const LonLat> centers, GridShape shape) {
  const system::ArithmeticScope arithmetic;
  if (shape.rows < 2 || shape.columns < 2 || centers.size() / shape.columns != shape.rows ||
      centers.size() % shape.columns != 0) {
    throw InvalidInput(std::to_string(centers.size()) + " centers are no grid of " +
                       std::to_string(shape.rows) + " x " + std::to_string(shape.columns) +
                       " with two rows and two columns or more");
  }
  const FramedCenters framed(centers, shape);
  std::vector<LonLat> nodes;
  nodes.reserve((shape.rows + 1) * (shape.columns + 1));
  for (std::size_t j = 0; j <= shape.rows; ++j) {
    for (std::size_t i = 0; i <= shape.columns; ++i) nodes.push_back(framed.node(j, i));
  }
  return nodes;
}

}  // namespace rondel
