// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/face_map.h"

#include <algorithm>
#include <cmath>

#include "map/arc.h"

namespace rondel::map {
namespace {

constexpr double largest_tolerance_deg = 0.01;
constexpr double least_tolerance_deg = 1e-5;

// Doubles do not tell which way the arc between two opposite corners takes. A solid face has no
// opposite corners, but they may be opposite when they are rounded.
bool is_determined(const std::array<Point, 3>& ring) {
  const auto are_opposite = [](const Point& p, const Point& q) {
    return norm(p + q) <= merge_distance;
  };
  return !are_opposite(ring[0], ring[1]) && !are_opposite(ring[1], ring[2]) &&
         !are_opposite(ring[2], ring[0]);
}

}  // namespace

std::vector<LonLatPolygon> FaceMap::polygons(Index face) const {
  const Corners corners = ring(face);
  if (!is_determined(corners)) return {};
  return lonlat_polygons(corners, tolerances(face));
}

// The corners on the unit sphere.
FaceMap::Corners FaceMap::ring(Index face) const {
  const auto& [a, b, c] = triangulation_.faces()[face];
  const Point& center = triangulation_.sphere().center;
  return {direction(sites_[a], center), direction(sites_[b], center), direction(sites_[c], center)};
}

// The tolerances of the edges 01, 12 and 20.
std::array<double, 3> FaceMap::tolerances(Index face) const {
  const auto& neighbors = triangulation_.neighbors()[face];
  const double own = tolerance(face);
  const auto edge = [&](std::size_t opposite) {
    const Index neighbor = neighbors[opposite];
    return triangulation_.is_ghost(neighbor) ? own : std::min(own, tolerance(neighbor));
  };
  return {edge(2), edge(0), edge(1)};
}

double FaceMap::tolerance(Index face) const {
  const auto [a, b, c] = ring(face);
  const Point ab = b - a;
  const Point bc = c - b;
  const double longest = std::max({norm(ab), norm(bc), norm(a - c)});
  if (longest == 0) return least_tolerance_deg;  // one place after rounding
  const double height_deg = norm(cross(ab, bc)) / longest * degrees_per_radian;
  return std::clamp(height_deg / 10, least_tolerance_deg, largest_tolerance_deg);
}

}  // namespace rondel::map
