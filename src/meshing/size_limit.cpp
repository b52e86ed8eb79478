// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sweeps over the faces of the cube, back and forth, until nothing changes. A node is compared with
// the eight nodes that the sweep has visited before it. Between sweeps the nodes that faces share
// take the least of their values.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "meshing/size_raster.h"

namespace rondel::mesh {
namespace {

struct Shift {
  int i;
  int j;
};
// Half of the sixteen neighbors at king's and knight's moves; the others are opposite to them.
constexpr std::array<Shift, 8> shifts = {
    {{-1, 0}, {0, -1}, {-1, -1}, {1, -1}, {-2, -1}, {2, -1}, {-1, -2}, {1, -2}}};

// Lowers the values at the nodes of a raster.
class Limiter {
 public:
  Limiter(const CubeRaster& cube, double slope, std::vector<double>& values)
      : cube_(cube), slope_(slope), values_(values) {}

  void run() {
    bool has_changed = true;
    while (has_changed) {
      has_changed = share_borders();
      for (std::size_t face = 0; face < 6; ++face) {
        if (sweep(face, 1)) has_changed = true;
        if (sweep(face, -1)) has_changed = true;
      }
    }
  }

 private:
  // Visits the nodes of a face row by row, forward or backward; true if a value has changed.
  bool sweep(std::size_t face, int sign) {
    const auto side = static_cast<int>(cube_.side());
    bool has_changed = false;
    for (int row = 0; row < side; ++row) {
      const int j = sign > 0 ? row : side - 1 - row;
      for (int column = 0; column < side; ++column) {
        const int i = sign > 0 ? column : side - 1 - column;
        if (lower(face, i, j, sign)) has_changed = true;
      }
    }
    return has_changed;
  }

  // Lowers the value of a node to what its neighbors allow; true if it was more.
  bool lower(std::size_t face, int i, int j, int sign) {
    const auto side = static_cast<int>(cube_.side());
    double& value = values_[node(face, i, j)];
    const double before = value;
    Point place{};
    bool has_place = false;
    for (const Shift& shift : shifts) {
      const int k = i + sign * shift.i;
      const int l = j + sign * shift.j;
      if (k < 0 || l < 0 || k >= side || l >= side) continue;
      const double other = values_[node(face, k, l)];
      if (other >= value) continue;
      if (!has_place) place = at(face, i, j);
      has_place = true;
      const double distance = norm(exact::to_vector(place) - exact::to_vector(at(face, k, l)));
      value = std::min(value, other + slope_ * distance);
    }
    return value < before;
  }

  // Gives the nodes on a face's border and their copies on other faces one value; returns true if
  // any changed.
  bool share_borders() {
    bool has_changed = false;
    for (std::size_t face = 0; face < 6; ++face) {
      for (std::size_t k = 0; k < cube_.side(); ++k) {
        for (const auto& [i, j] : {std::array{k, std::size_t{0}}, std::array{k, cube_.steps},
                                   std::array{std::size_t{0}, k}, std::array{cube_.steps, k}}) {
          if (share(face, i, j)) has_changed = true;
        }
      }
    }
    return has_changed;
  }

  bool share(std::size_t face, std::size_t i, std::size_t j) {
    const auto p = cube_.on_cube(face, i, j);
    double& value = values_[cube_.node(face, i, j)];
    const double before = value;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::abs(p[axis]) != 1) continue;
      const std::size_t other = 2 * axis + (p[axis] < 0 ? 1 : 0);
      value = std::min(
          value,
          values_[cube_.node(other, step_of(p[(axis + 1) % 3]), step_of(p[(axis + 2) % 3]))]);
    }
    return value < before;
  }

  // Returns the step of a coordinate. This is exact, since the number of steps is a power of two.
  [[nodiscard]] std::size_t step_of(double coordinate) const {
    return static_cast<std::size_t>((coordinate + 1) * 0.5 * static_cast<double>(cube_.steps));
  }
  [[nodiscard]] std::size_t node(std::size_t face, int i, int j) const {
    return cube_.node(face, static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }
  [[nodiscard]] Point at(std::size_t face, int i, int j) const {
    return cube_.place(face, static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }

  const CubeRaster& cube_;
  double slope_;
  std::vector<double>& values_;
};

}  // namespace

void limit_slope(const CubeRaster& cube, double slope, std::vector<double>& values) {
  Limiter(cube, slope, values).run();
}

}  // namespace rondel::mesh
