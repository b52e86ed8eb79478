// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A set of indices that grows with what a query visits, not with the number of sites, and is
// cleared in constant time: a query pays nothing for the memory that a larger one before it needed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondel/types.h"
#include "system/hash.h"

namespace rondel::query {

// Open addressing with linear probing, at most half full. A slot is in use if it has the stamp of
// the time since the last clear(). Only when the stamps have all been used is every slot written.
template <class Stamp>
class StampedSet {
 public:
  // Whether it was not there.
  bool insert(Index value) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    Slot& slot = find(value);
    if (slot.stamp == now_) return false;
    slot.value = value;
    slot.stamp = now_;
    ++size_;
    return true;
  }

  [[nodiscard]] bool contains(Index value) const {
    return !slots_.empty() && slots_[place_of(value)].stamp == now_;
  }

  void clear() {
    size_ = 0;
    ++now_;
    if (now_ != never) return;
    for (Slot& slot : slots_) slot.stamp = never;
    ++now_;
  }

 private:
  static constexpr Stamp never{};

  struct Slot {
    Index value = 0;
    Stamp stamp{};
  };

  // The number of the slot that has the value, or of the one where it belongs.
  [[nodiscard]] std::size_t place_of(Index value) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = static_cast<std::size_t>((value * system::golden_multiplier) >> 24) & mask;
    while (slots_[i].stamp == now_ && slots_[i].value != value) i = (i + 1) & mask;
    return i;
  }
  Slot& find(Index value) { return slots_[place_of(value)]; }

  void grow() {
    constexpr std::size_t least = 64;
    std::vector<Slot> old(slots_.empty() ? least : 2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.stamp == now_) find(slot.value) = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t size_ = 0;
  Stamp now_{1};
};

using VisitedSet = StampedSet<std::uint32_t>;

}  // namespace rondel::query
