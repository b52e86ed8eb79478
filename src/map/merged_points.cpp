// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/merged_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "map/arc.h"
#include "system/hash.h"

namespace rondel::map {
namespace {

// Cubes are 16 times as wide as merge_distance. So most points need no search in a neighboring
// cube, and since kept points are apart, no cube has many.
constexpr double cubes_per_unit = 1 / (16 * merge_distance);

struct Cube {
  std::array<std::int64_t, 3> place{};
};

// Returns the number of the cube along an axis, at least 0, for a coordinate from -2 to 2. It is a
// non-decreasing function of the coordinate, and no other property of it changes what is merged.
std::int64_t place_of(double coordinate) {
  return static_cast<std::int64_t>((coordinate + 2) * cubes_per_unit);
}

// The points that are kept, in linked lists by the slot of their cube.
class KeptPoints {
 public:
  explicit KeptPoints(std::span<const Point> points)
      : points_(points),
        firsts_(std::bit_ceil(2 * points.size() + 1), no_index),
        next_(points.size(), no_index) {}

  // Returns the first kept point, in the order of addition, within merge_distance of a point, or
  // no_index.
  [[nodiscard]] Index find_near(const Point& p) const {
    const Cube low = cube_of({p.x - merge_distance, p.y - merge_distance, p.z - merge_distance});
    const Cube high = cube_of({p.x + merge_distance, p.y + merge_distance, p.z + merge_distance});
    Index found = no_index;
    Cube cube;
    for (cube.place[0] = low.place[0]; cube.place[0] <= high.place[0]; ++cube.place[0]) {
      for (cube.place[1] = low.place[1]; cube.place[1] <= high.place[1]; ++cube.place[1]) {
        for (cube.place[2] = low.place[2]; cube.place[2] <= high.place[2]; ++cube.place[2])
          found = std::min(found, find_near_in(cube, p));
      }
    }
    return found;
  }

  void add(Index i) {
    Index& first = firsts_[slot_of(cube_of(points_[i]))];
    next_[i] = first;
    first = i;
  }

 private:
  static Cube cube_of(const Point& p) { return {{place_of(p.x), place_of(p.y), place_of(p.z)}}; }

  [[nodiscard]] std::size_t slot_of(const Cube& cube) const {
    std::uint64_t hash = 0;
    for (const std::int64_t place : cube.place) {
      hash = system::mixed(hash, static_cast<std::uint64_t>(place));
    }
    return static_cast<std::size_t>(hash) & (firsts_.size() - 1);
  }

  [[nodiscard]] Index find_near_in(const Cube& cube, const Point& p) const {
    Index found = no_index;
    for (Index i = firsts_[slot_of(cube)]; i != no_index; i = next_[i]) {
      if (distance(points_[i], p) <= merge_distance) found = std::min(found, i);
    }
    return found;
  }

  std::span<const Point> points_;
  std::vector<Index> firsts_;
  std::vector<Index> next_;
};

}  // namespace

std::vector<Point> merged_points(std::span<const Point> points) {
  std::vector<Point> merged;
  merged.reserve(points.size());
  for (const Point& p : points) merged.push_back(snapped(p));
  KeptPoints kept(merged);
  for (std::size_t i = 0; i < merged.size(); ++i) {
    const Index near = kept.find_near(merged[i]);
    if (near == no_index) {
      kept.add(static_cast<Index>(i));
    } else {
      merged[i] = merged[near];
    }
  }
  return merged;
}

}  // namespace rondel::map
