// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sorts keys and their indices together, and words alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::order {

struct KeyedIndices {
  std::vector<std::uint64_t> keys;
  std::vector<Index> indices;
};

// Sorts by the lower `bits` bits of the keys, the higher ones being 0.
RONDEL_API void radix_sort(KeyedIndices& data, int bits);

// Sorts words that fit the cache: `words` into `result`, of the same size; uses up `words`. Linear
// in their number if their leading bits differ, and in any case linear in their number times their
// bits.
void sort_words(std::span<std::uint64_t> words, std::span<std::uint64_t> result);

}  // namespace rondel::order
