// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds equal points, or equal positions of longitude and latitude.
//
// in    points or positions
// out   each different one once, and the number of each given one among these
// index points or positions, as given
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "rondel/types.h"
#include "system/hash.h"
#include "system/large_arrays.h"
#include "system/prefetch.h"

namespace rondel::system {

// The different values, in the order in which they first occur, and for each given value the index
// of its equal among them. 0 and -0 are equal.
template <class Value>
struct Distinct {
  std::vector<Value> values;
  std::vector<Index> numbers;
};

// Numbers values in the order in which they first occur, in a hash table that grows. Corners of
// cells occur three or more times each. A slot has half of the hash, so that values are rarely
// compared in vain.
template <class Value>
class KnownValues {
 public:
  // A table with a slot for each of the values that are expected grows once at most.
  KnownValues(std::vector<Value>& values, std::size_t num_expected)
      : values_(values), slots_(std::bit_ceil(std::max(num_expected, least_slots))) {}

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

  static constexpr std::size_t least_slots = 64;

  std::vector<Value>& values_;
  std::vector<ValueSlot> slots_;
};

// Returns the different ones of some points or positions.
template <class Value>
Distinct<Value> distinct(std::span<const Value> values) {
  Distinct<Value> result;
  result.numbers = large_vector<Index>(values.size());
  KnownValues<Value> known(result.values, values.size());
  std::array<std::uint64_t, prefetch_distance> hashes{};  // the hashes of the next values
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

}  // namespace rondel::system
