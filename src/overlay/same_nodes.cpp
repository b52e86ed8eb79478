// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/same_nodes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace rondel::overlay {
namespace {

struct Cube {
  std::int64_t x;
  std::int64_t y;
  std::int64_t z;
  bool operator==(const Cube&) const = default;
};

struct CubeHash {
  std::size_t operator()(const Cube& cube) const {
    constexpr std::uint64_t factor = 0x9e37'79b9'7f4a'7c15;
    std::uint64_t hash = 0;
    for (const std::int64_t k : {cube.x, cube.y, cube.z}) {
      hash = (hash ^ static_cast<std::uint64_t>(k)) * factor;
      hash ^= hash >> 32U;
    }
    return hash;
  }
};

}  // namespace

// Points that have none are kept in cubes much wider than the distance, so that a point looks into one cube, and rarely
// into a neighbor of it.
std::vector<Index> same_nodes(std::span<const Point> points, double distance) {
  const double width = 16 * distance;
  const auto place = [&](double coordinate) {
    return static_cast<std::int64_t>(std::floor(coordinate / width));
  };
  std::unordered_map<Cube, std::vector<Index>, CubeHash> cubes;
  cubes.reserve(points.size());
  const auto is_same = [&](const Point& p, const Point& q) {
    return std::abs(p.x - q.x) <= distance && std::abs(p.y - q.y) <= distance &&
           std::abs(p.z - q.z) <= distance;
  };
  const auto first_near = [&](const Point& p) {
    Index first = no_index;
    for (auto x = place(p.x - distance); x <= place(p.x + distance); ++x) {
      for (auto y = place(p.y - distance); y <= place(p.y + distance); ++y) {
        for (auto z = place(p.z - distance); z <= place(p.z + distance); ++z) {
          const auto cube = cubes.find({x, y, z});
          if (cube == cubes.end()) continue;
          for (const Index i : cube->second) {
            if (is_same(points[i], p)) first = std::min(first, i);
          }
        }
      }
    }
    return first;
  };
  std::vector<Index> result(points.size());
  for (Index i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    const Index first = first_near(p);
    result[i] = first == no_index ? i : first;
    if (first == no_index) cubes[{place(p.x), place(p.y), place(p.z)}].push_back(i);
  }
  return result;
}

}  // namespace rondel::overlay
