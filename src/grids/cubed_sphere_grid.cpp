// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <cmath>
#include <utility>

#include "exact/vector.h"
#include "grids/grid_formula.h"
#include "meshing/point_rings.h"
#include "rondel/delaunay.h"

namespace rondel::grids {
namespace {

class CubedSphereGrid : public GridFormula {
 public:
  explicit CubedSphereGrid(Index side) : side_(side) {
    for (std::size_t line = 0; line <= 2 * std::size_t{side}; ++line) {
      tangents_.push_back(mesh::cube_tangent(side, line));
    }
    // Both halves of a face mirror each other, so that faces agree on their common edges.
    for (std::size_t line = 0; line < side; ++line) {
      tangents_[2 * std::size_t{side} - line] = -tangents_[line];
    }
    tangents_[side] = 0;
  }

  [[nodiscard]] Index num_cells() const override { return 6 * side_ * side_; }
  [[nodiscard]] std::vector<std::uint64_t> shape() const override { return {6, side_, side_}; }

  [[nodiscard]] LonLat center(Index cell) const override {
    const CubeCell at = place_of(cell);
    return lonlats(std::vector<Point>{point_of(at.face, 2 * at.column + 1, 2 * at.row + 1)})[0];
  }

  void append_ring(Index cell, std::vector<Point>& ring) const override {
    const auto [face, row, column] = place_of(cell);
    ring.push_back(point_of(face, 2 * column, 2 * row));
    ring.push_back(point_of(face, 2 * column + 2, 2 * row));
    ring.push_back(point_of(face, 2 * column + 2, 2 * row + 2));
    ring.push_back(point_of(face, 2 * column, 2 * row + 2));
  }

 private:
  struct CubeCell {
    unsigned face;
    std::size_t row;
    std::size_t column;
  };
  [[nodiscard]] CubeCell place_of(Index cell) const {
    const Index of_face = side_ * side_;
    return {cell / of_face, cell % of_face / side_, cell % side_};
  }
  // The sum of squares is the same for both faces that have a point.
  [[nodiscard]] Point point_of(unsigned face, std::size_t column, std::size_t row) const {
    const double a = tangents_[column];
    const double b = tangents_[row];
    return mesh::on_cube(face, a, b) / std::sqrt(1 + (a * a + b * b));
  }

  Index side_;
  std::vector<double> tangents_;  // of the lines at every half step
};

}  // namespace

std::unique_ptr<GridFormula> cubed_sphere_grid(unsigned side) {
  return std::make_unique<CubedSphereGrid>(side);
}

}  // namespace rondel::grids
