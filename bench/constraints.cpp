// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "constraints.h"

#include <algorithm>
#include <cmath>

#include "rondel/predicates.h"

namespace rondel::bench {
namespace {

using Edge = std::array<Index, 2>;

// Returns the number of the square, of side^2 on each face of the cube.
std::size_t square_of(const Point& p, std::size_t side) {
  const double ax = std::abs(p.x);
  const double ay = std::abs(p.y);
  const double az = std::abs(p.z);
  const double longest = std::max({ax, ay, az});
  const bool is_x = ax == longest;
  const bool is_y = !is_x && ay == longest;
  const double out = is_x ? p.x : is_y ? p.y : p.z;
  const double u = (is_x ? p.y : p.x) / longest;
  const double v = (is_x || is_y ? p.z : p.y) / longest;
  const auto cell = [side](double ratio) {
    const auto place = static_cast<std::size_t>((ratio + 1) / 2 * static_cast<double>(side));
    return std::min(place, side - 1);
  };
  const std::size_t face = (is_x ? 0U : is_y ? 2U : 4U) + (out < 0 ? 1U : 0U);
  return (face * side + cell(u)) * side + cell(v);
}

bool do_cross(const std::vector<Point>& sites, const Edge& e, const Edge& f) {
  const auto side = [&](const Edge& edge, Index v) {
    return static_cast<int>(orientation(sites[edge[0]], sites[edge[1]], sites[v]));
  };
  return side(e, f[0]) * side(e, f[1]) < 0 && side(f, e[0]) * side(f, e[1]) < 0;
}

}  // namespace

std::vector<std::array<Index, 2>> random_constraints(const std::vector<Point>& sites,
                                                     std::size_t wanted) {
  constexpr unsigned each = 4;
  const auto squares = static_cast<double>(wanted) / each / 6;  // on a face
  const auto side = std::max<std::size_t>(static_cast<std::size_t>(std::sqrt(squares)), 1);
  std::vector<std::vector<Index>> in_square(6 * side * side);
  for (Index i = 0; i < sites.size(); ++i) in_square[square_of(sites[i], side)].push_back(i);
  std::vector<Edge> constraints;
  for (const std::vector<Index>& square : in_square) {
    const std::size_t first = constraints.size();
    for (std::size_t k = 1; k < square.size() && constraints.size() < first + each; ++k) {
      const Edge edge = {square[k - 1], square[k]};
      const auto crosses = [&](const Edge& other) { return do_cross(sites, edge, other); };
      if (std::none_of(constraints.begin() + static_cast<std::ptrdiff_t>(first), constraints.end(),
                       crosses)) {
        constraints.push_back(edge);
      }
    }
  }
  return constraints;
}

}  // namespace rondel::bench
