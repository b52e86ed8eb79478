// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sweeps over the faces of a raster, back and forth, until nothing changes. A node is compared with
// the eight nodes that the sweep has visited before it. Between sweeps the nodes that faces of the
// cube share take the least of their values.
//
// The distance of two nodes is computed only if a bound below it does not do. On the plane of a face
// let nodes be d apart, and at p and q from the center of the sphere, n = |p|. The sine of the angle
// between them is |p x q| / (|p| |q|), and |p x q| >= d, since the plane is at distance 1. With
// |q| <= n + d the chord, which is longer than the sine, is at least d / (n^2 + n d).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <variant>

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
template <class Nodes>
class Limiter {
 public:
  Limiter(const Nodes& nodes, double slope, std::vector<double>& values)
      : nodes_(nodes), slope_(slope), values_(values) {
    const double dx = nodes.x(1) - nodes.x(0);
    const double dy = nodes.y(1) - nodes.y(0);
    for (std::size_t k = 0; k < shifts.size(); ++k) {
      const double x = shifts[k].i * dx;
      const double y = shifts[k].j * dy;
      lengths_[k] = std::sqrt(x * x + y * y);
    }
    longest_ = *std::ranges::max_element(lengths_);
  }

  void run() {
    bool has_changed = true;
    while (has_changed) {
      has_changed = share_borders();
      for (std::size_t face = 0; face < nodes_.num_faces(); ++face) {
        if (sweep(face, 1)) has_changed = true;
        if (sweep(face, -1)) has_changed = true;
      }
    }
  }

 private:
  // Visits the nodes of a face row by row, forward or backward; true if a value has changed.
  bool sweep(std::size_t face, int sign) {
    const auto rows = static_cast<int>(nodes_.rows());
    const auto columns = static_cast<int>(nodes_.columns());
    bool has_changed = false;
    for (int row = 0; row < rows; ++row) {
      const int j = sign > 0 ? row : rows - 1 - row;
      for (int column = 0; column < columns; ++column) {
        const int i = sign > 0 ? column : columns - 1 - column;
        if (lower(face, i, j, sign)) has_changed = true;
      }
    }
    return has_changed;
  }

  // Lowers the value of a node to what its neighbors allow; true if it was more.
  bool lower(std::size_t face, int i, int j, int sign) {
    const auto rows = static_cast<int>(nodes_.rows());
    const auto columns = static_cast<int>(nodes_.columns());
    double& value = values_[node(face, i, j)];
    const double before = value;
    double least = 0;  // slope times a bound of the distance, for each length on the plane
    Point place{};
    bool has_place = false;
    for (std::size_t n = 0; n < shifts.size(); ++n) {
      const int k = i + sign * shifts[n].i;
      const int l = j + sign * shifts[n].j;
      if (k < 0 || l < 0 || k >= columns || l >= rows) continue;
      const double other = values_[node(face, k, l)];
      if (other >= value) continue;
      if (least == 0) least = slope_ * least_chord(i, j);
      if (other + least * lengths_[n] >= value) continue;
      if (!has_place) place = at(face, i, j);
      has_place = true;
      const double distance = norm(exact::to_vector(place) - exact::to_vector(at(face, k, l)));
      value = std::min(value, other + slope_ * distance);
    }
    return value < before;
  }

  // Returns a bound below the chord to a neighbor over its length on the plane, less what rounding may
  // take.
  [[nodiscard]] double least_chord(int i, int j) const {
    const double x = nodes_.x(static_cast<std::size_t>(i));
    const double y = nodes_.y(static_cast<std::size_t>(j));
    const double square = 1 + x * x + y * y;
    constexpr double rounding = 1 - 1e-3;
    return rounding / (square + std::sqrt(square) * longest_);
  }

  // Gives the nodes on a face's border and their copies on other faces one value; returns true if
  // any changed.
  bool share_borders() {
    bool has_changed = false;
    if constexpr (std::is_same_v<Nodes, CubeRaster>) {
      const std::size_t last = nodes_.steps;
      for (std::size_t face = 0; face < nodes_.num_faces(); ++face) {
        for (std::size_t k = 0; k <= last; ++k) {
          for (const auto& [i, j] : {std::array{k, std::size_t{0}}, std::array{k, last},
                                     std::array{std::size_t{0}, k}, std::array{last, k}}) {
            if (share(face, i, j)) has_changed = true;
          }
        }
      }
    }
    return has_changed;
  }

  bool share(std::size_t face, std::size_t i, std::size_t j) {
    const auto p = nodes_.on_cube(face, i, j);
    double& value = values_[nodes_.node(face, i, j)];
    const double before = value;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::abs(p[axis]) != 1) continue;
      const std::size_t other = 2 * axis + (p[axis] < 0 ? 1 : 0);
      value = std::min(
          value,
          values_[nodes_.node(other, step_of(p[(axis + 1) % 3]), step_of(p[(axis + 2) % 3]))]);
    }
    return value < before;
  }

  // Returns the step of a coordinate. This is exact, since the number of steps is a power of two.
  [[nodiscard]] std::size_t step_of(double coordinate) const {
    return static_cast<std::size_t>((coordinate + 1) * 0.5 * static_cast<double>(nodes_.steps));
  }
  [[nodiscard]] std::size_t node(std::size_t face, int i, int j) const {
    return nodes_.node(face, static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }
  [[nodiscard]] Point at(std::size_t face, int i, int j) const {
    return nodes_.place(face, static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }

  const Nodes& nodes_;
  double slope_;
  std::vector<double>& values_;
  std::array<double, shifts.size()> lengths_{};  // of shifts on the plane
  double longest_ = 0;
};

}  // namespace

void limit_slope(const AnyRaster& raster, double slope, std::vector<double>& values) {
  std::visit([&](const auto& nodes) { Limiter(nodes, slope, values).run(); }, raster);
}

}  // namespace rondel::mesh
