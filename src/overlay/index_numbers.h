// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers indices 0, 1, ... in the order in which they first occur.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/types.h"
#include "system/hash.h"

namespace rondel::overlay {

// A hash table with open addressing and linear probing, at most half full. A slot is in use if its
// stamp is that of the time since the last clear(), so that clear() takes constant time.
class IndexNumbers {
 public:
  IndexNumbers() : slots_(min_slots) {}

  // Returns the number of a key, and assigns the next number to a new key.
  Index operator()(Index key) {
    if (2 * (keys_.size() + 1) > slots_.size()) grow();
    NumberedIndex& slot = slot_of(key);
    if (slot.stamp != now_) {
      slot = {key, static_cast<Index>(keys_.size()), now_};
      keys_.push_back(key);
    }
    return slot.number;
  }
  // Returns the keys by their numbers.
  [[nodiscard]] std::span<const Index> keys() const { return keys_; }

  void clear() {
    keys_.clear();
    if (++now_ != 0) return;
    for (NumberedIndex& slot : slots_) slot.stamp = 0;
    now_ = 1;
  }

 private:
  static constexpr std::size_t min_slots = 64;

  struct NumberedIndex {
    Index key = 0;
    Index number = 0;
    std::uint32_t stamp = 0;
  };

  // Returns the slot of a key, or the free slot where it belongs.
  NumberedIndex& slot_of(Index key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t k = static_cast<std::size_t>((key * system::golden_multiplier) >> 32) & mask;
    while (slots_[k].stamp == now_ && slots_[k].key != key) k = (k + 1) & mask;
    return slots_[k];
  }
  void grow() {
    slots_.assign(2 * slots_.size(), {});
    for (Index number = 0; number < keys_.size(); ++number) {
      slot_of(keys_[number]) = {keys_[number], number, now_};
    }
  }

  std::vector<NumberedIndex> slots_;
  std::vector<Index> keys_;
  std::uint32_t now_ = 1;
};

}  // namespace rondel::overlay
