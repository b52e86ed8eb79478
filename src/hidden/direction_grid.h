// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Directions sorted into the cells of a grid on the cube around the origin.
//
//     v ^ +--+--+--+       side 2*axis + (1 if negative); on it the other two coordinates,
//       | +--+--+--+       in cyclic order and divided by the longest, give the place
//       | +--+--+--+       (u, v) in units of cells
//         -----------> u
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "predicates/rung.h"

namespace rondel::hidden {

struct Direction {
  unsigned side;
  double length;  // the longest coordinate; 0: no direction, or too short to be divided by
  double u;
  double v;
};

class DirectionGrid {
 public:
  // `cells` along an edge of the cube.
  explicit DirectionGrid(unsigned cells) : cells_(cells), half_(0.5 * cells) {}

  [[nodiscard]] unsigned cells() const { return cells_; }
  [[nodiscard]] std::size_t num_cells() const { return std::size_t{6} * cells_ * cells_; }

  // u and v are off by at most 3 * 2^-53 times the number of cells.
  [[nodiscard]] Direction direction(const predicates::Vector& p) const {
    const double x = std::abs(p.x);
    const double y = std::abs(p.y);
    const double z = std::abs(p.z);
    const bool is_y = y > x;
    const bool is_z = z > std::max(x, y);
    // Selections instead of branches, which random sites would make unpredictable.
    const double along = is_z ? p.z : (is_y ? p.y : p.x);
    const double next = is_z ? p.x : (is_y ? p.z : p.y);
    const double last = is_z ? p.y : (is_y ? p.x : p.z);
    const double length = std::abs(along) > min_length ? std::abs(along) : 0;
    const double factor = half_ / length;
    const unsigned axis = is_z ? 2 : (is_y ? 1 : 0);
    return {2 * axis + (along < 0 ? 1 : 0), length, next * factor + half_, last * factor + half_};
  }

  // Precondition: d has a direction.
  [[nodiscard]] std::size_t cell(const Direction& d) const {
    return (std::size_t{d.side} * cells_ + step(d.u)) * cells_ + step(d.v);
  }
  // The cell along one edge; the far end belongs to the last one.
  [[nodiscard]] std::size_t step(double u) const {
    return std::min(static_cast<std::size_t>(u), std::size_t{cells_ - 1});
  }

  // The point of the cube's side at (u, v).
  [[nodiscard]] predicates::Vector point(unsigned side, double u, double v) const {
    std::array<double, 3> c{};
    const unsigned axis = side / 2;
    c[axis] = side % 2 == 0 ? 1 : -1;
    c[(axis + 1) % 3] = u / half_ - 1;
    c[(axis + 2) % 3] = v / half_ - 1;
    return {c[0], c[1], c[2]};
  }

 private:
  static constexpr double min_length = 1e-290;

  unsigned cells_;
  double half_;
};

}  // namespace rondel::hidden
