// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "meshing/small_parts.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "exact/point_order.h"
#include "map/ring_area.h"
#include "system/disjoint_sets.h"

namespace rondel::meshing {
namespace {

// Returns the part and the area of each triangle in an order that their numbers do not change, so that
// parts of the same form have the same area, to the last bit.
std::vector<std::pair<Index, double>> areas_in(system::DisjointSets& parts,
                                               std::span<const Point> points,
                                               std::span<const Triple> triangles) {
  std::vector<std::pair<Index, double>> areas;
  areas.reserve(triangles.size());
  for (Index t = 0; t < triangles.size(); ++t) {
    std::array<Point, 3> corners;
    std::ranges::transform(triangles[t], corners.begin(), [&](Index i) { return points[i]; });
    std::rotate(corners.begin(), std::ranges::min_element(corners, exact::is_less), corners.end());
    areas.emplace_back(parts[t], map::area_on_left(corners));
  }
  std::ranges::sort(areas);
  return areas;
}

}  // namespace

SmallParts small_parts(std::span<const Point> points, std::span<const Triple> triangles,
                       double share) {
  std::vector<std::tuple<Index, Index, Index>> sides;  // both nodes, the triangle
  std::vector<double> areas(triangles.size());
  for (Index t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
      sides.emplace_back(low, high, t);
    }
  }
  std::ranges::sort(sides);
  system::DisjointSets parts(triangles.size());
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const auto& [low, high, t] = sides[i];
    const auto& [other_low, other_high, other] = sides[i - 1];
    if (low == other_low && high == other_high) parts.join(other, t);
  }
  for (const auto& [part, area] : areas_in(parts, points, triangles)) areas[part] += area;
  const double least = areas.empty() ? 0 : share * *std::ranges::max_element(areas);
  SmallParts small{std::vector<bool>(triangles.size())};
  for (Index t = 0; t < triangles.size(); ++t) {
    small.has[t] = areas[parts[t]] < least;
    small.number += small.has[t] && parts[t] == t ? 1U : 0U;
  }
  return small;
}

}  // namespace rondel::meshing
