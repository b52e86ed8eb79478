// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A set of indices that grows with what a query visits, not with the number of sites.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondel/types.h"

namespace rondel::query {

// Open addressing with linear probing, at most half full.
class VisitedSet {
 public:
  // Whether it was not there. Precondition: not no_index.
  bool insert(Index value) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    Index& slot = find(value);
    if (slot == value) return false;
    slot = value;
    ++size_;
    return true;
  }

  void clear() {
    if (size_ != 0) slots_.assign(slots_.size(), no_index);
    size_ = 0;
  }

 private:
  Index& find(Index value) {
    constexpr std::uint64_t multiplier = 0x9e3779b97f4a7c15U;  // 2^64 over the golden ratio
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = static_cast<std::size_t>((value * multiplier) >> 24) & mask;
    while (slots_[i] != value && slots_[i] != no_index) i = (i + 1) & mask;
    return slots_[i];
  }

  void grow() {
    constexpr std::size_t least = 64;
    std::vector<Index> old(slots_.empty() ? least : 2 * slots_.size(), no_index);
    old.swap(slots_);
    for (const Index value : old) {
      if (value != no_index) find(value) = value;
    }
  }

  std::vector<Index> slots_;
  std::size_t size_ = 0;
};

}  // namespace rondel::query
