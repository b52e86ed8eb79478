// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A hash table of the directed sides of triangles by their ends. It is one array, because
// cover_triangulation.h spends most of its time on look-ups here.
//
// index points, by which sides are found; cells (`owner`); triangles
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondel/types.h"

namespace rondel::overlay {

// A directed side of a triangle.
struct TriangleSide {
  Index from = no_index;  // no_index in a free slot
  Index to = no_index;
  Index apex = no_index;      // the third corner of the triangle to its left
  Index owner = no_index;     // the cell to its left, if the side bounds one
  Index triangle = no_index;  // the index of the triangle to its left
};

// Open addressing with linear probing; at least half of the slots are free.
class SideTable {
 public:
  explicit SideTable(std::size_t expected)
      : slots_(std::bit_ceil(2 * expected + 2)), shift_(64 - std::countr_zero(slots_.size())) {}

  // Returns a side. Precondition: the side is in the table.
  [[nodiscard]] const TriangleSide& at(Index from, Index to) const {
    const TriangleSide& side = slots_[slot_of(from, to)];
    assert(side.from == from);
    return side;
  }
  // Returns a side, and inserts it if it is not in the table. The reference is valid until the next
  // insertion.
  TriangleSide& make(Index from, Index to) {
    std::size_t slot = slot_of(from, to);
    if (slots_[slot].from == no_index) {
      if (2 * (size_ + 1) > slots_.size()) {
        grow();
        slot = slot_of(from, to);
      }
      slots_[slot].from = from;
      slots_[slot].to = to;
      ++size_;
    }
    return slots_[slot];
  }

 private:
  // Returns the slot of a side, or the free slot where it belongs. Sides of points with neighboring
  // numbers are put near each other where there is room: such points are neighbors, so that
  // look-ups hit the cache.
  [[nodiscard]] std::size_t slot_of(Index from, Index to) const {
    constexpr std::uint64_t odd = 0x9e37'79b9'7f4a'7c15;  // 2^64 over the golden ratio
    constexpr std::size_t of_point = 12;
    constexpr std::size_t max_steps = 16;
    const std::size_t last = slots_.size() - 1;
    std::size_t slot = (from * of_point + (to * odd >> 61U)) & last;
    for (std::size_t k = 0; k < max_steps; ++k) {
      if (is_place_of(slot, from, to)) return slot;
      slot = (slot + 1) & last;
    }
    slot = ((std::uint64_t{from} << 32U | to) * odd) >> shift_;
    while (!is_place_of(slot, from, to)) slot = (slot + 1) & last;
    return slot;
  }
  // True if a slot is free or has this side.
  [[nodiscard]] bool is_place_of(std::size_t slot, Index from, Index to) const {
    const TriangleSide& side = slots_[slot];
    return side.from == no_index || (side.from == from && side.to == to);
  }
  void grow() {
    std::vector<TriangleSide> before(2 * slots_.size());
    before.swap(slots_);
    --shift_;
    for (const TriangleSide& side : before) {
      if (side.from != no_index) slots_[slot_of(side.from, side.to)] = side;
    }
  }

  std::vector<TriangleSide> slots_;  // as many as a power of two
  int shift_;
  std::size_t size_ = 0;
};

}  // namespace rondel::overlay
