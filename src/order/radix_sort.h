// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sorts keys and their indices together.
#pragma once

#include <cstdint>
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

}  // namespace rondel::order
