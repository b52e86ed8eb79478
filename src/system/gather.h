// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays in a new order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "rondel/types.h"
#include "system/large_arrays.h"
#include "system/prefetch.h"

namespace rondel::system {

// values[order[0]], values[order[1]] ..., with room for so many in all.
template <class Values>
auto gather(const Values& values, std::span<const Index> order, std::size_t room = 0) {
  std::vector<typename Values::value_type> result;
  system::reserve_large(result, std::max(room, order.size()));
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + prefetch_distance < order.size()) prefetch(&values[order[i + prefetch_distance]]);
    result.push_back(values[order[i]]);
  }
  return result;
}

}  // namespace rondel::system
