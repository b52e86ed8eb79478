// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/same_nodes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "system/hash.h"
#include "system/prefetch.h"

namespace rondel::overlay {
namespace {

std::uint64_t hash_of(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  return system::mixed(system::mixed(system::mixed(0, x), y), z);
}

// Finds points by the cubes that have them. Cubes are much wider than the distance, so that a point
// looks into one cube, and rarely into a neighbor of it.
class NearPoints {
 public:
  NearPoints(std::span<const Point> points, double distance)
      : points_(points),
        distance_(distance),
        cubes_per_unit_(1 / (16 * distance)),
        slots_(std::bit_ceil(2 * points.size() + 1), no_index) {}

  void prefetch(const Point& p) const {
    system::prefetch(&slots_[slot(place(p.x), place(p.y), place(p.z))]);
  }

  // Returns the first stored point near p, or no_index.
  [[nodiscard]] Index find(const Point& p) const {
    Index first = no_index;
    for (auto x = place(p.x - distance_); x <= place(p.x + distance_); ++x) {
      for (auto y = place(p.y - distance_); y <= place(p.y + distance_); ++y) {
        for (auto z = place(p.z - distance_); z <= place(p.z + distance_); ++z) {
          for (std::size_t s = slot(x, y, z); slots_[s] != no_index; s = next(s)) {
            if (is_near(points_[slots_[s]], p)) first = std::min(first, slots_[s]);
          }
        }
      }
    }
    return first;
  }
  void insert(Index i) {
    const Point& p = points_[i];
    std::size_t s = slot(place(p.x), place(p.y), place(p.z));
    while (slots_[s] != no_index) s = next(s);
    slots_[s] = i;
  }

 private:
  [[nodiscard]] std::int64_t place(double coordinate) const {
    return static_cast<std::int64_t>(std::floor(coordinate * cubes_per_unit_));
  }
  [[nodiscard]] std::size_t slot(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return hash_of(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y),
                   static_cast<std::uint64_t>(z)) &
           (slots_.size() - 1);
  }
  [[nodiscard]] std::size_t next(std::size_t slot) const {
    return (slot + 1) & (slots_.size() - 1);
  }
  // True if two points are within the distance in each coordinate.
  [[nodiscard]] bool is_near(const Point& p, const Point& q) const {
    return std::abs(p.x - q.x) <= distance_ && std::abs(p.y - q.y) <= distance_ &&
           std::abs(p.z - q.z) <= distance_;
  }

  std::span<const Point> points_;
  double distance_;
  double cubes_per_unit_;
  std::vector<Index> slots_;
};

}  // namespace

std::vector<Index> same_nodes(std::span<const Point> points, double distance) {
  NearPoints known(points, distance);
  std::vector<Index> result(points.size());
  for (Index i = 0; i < points.size(); ++i) {
    if (i + system::prefetch_distance < points.size()) {
      known.prefetch(points[i + system::prefetch_distance]);
    }
    const Index first = known.find(points[i]);
    result[i] = first == no_index ? i : first;
    if (first == no_index) known.insert(i);
  }
  return result;
}

}  // namespace rondel::overlay
