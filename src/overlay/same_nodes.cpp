// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/same_nodes.h"

#include <algorithm>
#include <array>
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

using system::hash_of;

std::uint64_t hash_of(const LonLat& position) {
  return hash_of(system::bits_of(position.lon_deg), system::bits_of(position.lat_deg), 0);
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

// Numbers values in the order in which they first occur, in a hash table that grows. Corners of
// cells occur three or more times each. A slot has half of the hash, so that values are rarely
// compared in vain.
template <class Value>
class KnownValues {
 public:
  explicit KnownValues(std::vector<Value>& values) : values_(values) {}

  void prefetch(std::uint64_t hash) const { system::prefetch(&slots_[hash & mask()]); }
  // Returns the number of a value, and adds the value if it is new.
  Index number(const Value& value, std::uint64_t hash) {
    const auto tag = static_cast<std::uint32_t>(hash >> 32U);
    std::size_t s = hash & mask();
    for (; slots_[s].number != no_index; s = (s + 1) & mask()) {
      if (slots_[s].tag == tag && values_[slots_[s].number] == value) return slots_[s].number;
    }
    const auto added = static_cast<Index>(values_.size());
    slots_[s] = {added, tag};
    values_.push_back(value);
    if (2 * values_.size() > slots_.size()) grow();
    return added;
  }

 private:
  struct ValueSlot {
    Index number = no_index;
    std::uint32_t tag = 0;
  };

  [[nodiscard]] std::size_t mask() const { return slots_.size() - 1; }
  void grow() {
    std::vector<ValueSlot> before(2 * slots_.size());
    before.swap(slots_);
    for (const ValueSlot& slot : before) {
      if (slot.number == no_index) continue;
      std::size_t s = hash_of(values_[slot.number]) & mask();
      while (slots_[s].number != no_index) s = (s + 1) & mask();
      slots_[s] = slot;
    }
  }

  std::vector<Value>& values_;
  std::vector<ValueSlot> slots_ = std::vector<ValueSlot>(1024);
};

template <class Value>
Distinct<Value> distinct_of(std::span<const Value> values) {
  Distinct<Value> result;
  result.numbers.resize(values.size());
  KnownValues<Value> known(result.values);
  std::array<std::uint64_t, system::prefetch_distance> hashes{};  // the hashes of the next values
  const auto prepare = [&](std::size_t k) {
    if (k >= values.size()) return;
    hashes[k % hashes.size()] = hash_of(values[k]);
    known.prefetch(hashes[k % hashes.size()]);
  };
  for (std::size_t k = 0; k < hashes.size(); ++k) prepare(k);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::uint64_t hash = hashes[k % hashes.size()];
    prepare(k + hashes.size());
    result.numbers[k] = known.number(values[k], hash);
  }
  return result;
}

}  // namespace

Distinct<LonLat> distinct(std::span<const LonLat> positions) { return distinct_of(positions); }
Distinct<Point> distinct(std::span<const Point> points) { return distinct_of(points); }

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
