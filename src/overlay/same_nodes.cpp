// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/same_nodes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace rondel::overlay {
namespace {

std::uint64_t hash_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  constexpr std::uint64_t factor = 0x9e37'79b9'7f4a'7c15;
  std::uint64_t hash = 0;
  for (const std::int64_t k : {x, y, z}) {
    hash = (hash ^ static_cast<std::uint64_t>(k)) * factor;
    hash ^= hash >> 32U;
  }
  return hash;
}

// Points by the cubes they are in, cubes much wider than the distance, so that a point looks into one, and rarely into a
// neighbor of it.
class NearPoints {
 public:
  NearPoints(std::span<const Point> points, double distance)
      : points_(points),
        distance_(distance),
        slots_(std::bit_ceil(2 * points.size() + 1), no_index) {}

  // The first point near to it; no_index: there is none.
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
    return static_cast<std::int64_t>(std::floor(coordinate / (16 * distance_)));
  }
  [[nodiscard]] std::size_t slot(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return hash_of(x, y, z) & (slots_.size() - 1);
  }
  [[nodiscard]] std::size_t next(std::size_t slot) const {
    return (slot + 1) & (slots_.size() - 1);
  }
  [[nodiscard]] bool is_near(const Point& p, const Point& q) const {
    return std::abs(p.x - q.x) <= distance_ && std::abs(p.y - q.y) <= distance_ &&
           std::abs(p.z - q.z) <= distance_;
  }

  std::span<const Point> points_;
  double distance_;
  std::vector<Index> slots_;
};

std::uint64_t hash_of(const LonLat& position) {
  return hash_of(std::bit_cast<std::int64_t>(position.lon_deg),
                 std::bit_cast<std::int64_t>(position.lat_deg), 0);
}

}  // namespace

DistinctPositions distinct_positions(std::span<const LonLat> positions) {
  DistinctPositions result;
  result.numbers.reserve(positions.size());
  std::vector<Index> slots(std::bit_ceil(2 * positions.size() + 1), no_index);
  for (const LonLat& position : positions) {
    std::size_t slot = hash_of(position) & (slots.size() - 1);
    while (slots[slot] != no_index && !(result.positions[slots[slot]] == position)) {
      slot = (slot + 1) & (slots.size() - 1);
    }
    if (slots[slot] == no_index) {
      slots[slot] = static_cast<Index>(result.positions.size());
      result.positions.push_back(position);
    }
    result.numbers.push_back(slots[slot]);
  }
  return result;
}

std::vector<Index> same_nodes(std::span<const Point> points, double distance) {
  NearPoints known(points, distance);
  std::vector<Index> result(points.size());
  for (Index i = 0; i < points.size(); ++i) {
    const Index first = known.find(points[i]);
    result[i] = first == no_index ? i : first;
    if (first == no_index) known.insert(i);
  }
  return result;
}

}  // namespace rondel::overlay
