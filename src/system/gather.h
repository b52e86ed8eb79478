// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays in a new order.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rondel/types.h"
#include "system/huge_pages.h"
#include "system/prefetch.h"

namespace rondel::system {

// values[order[0]], values[order[1]] ..., with room for more.
template <class T>
std::vector<T> gather(const std::vector<T>& values, std::span<const Index> order,
                      std::size_t room) {
  std::vector<T> result;
  system::reserve_large(result, room);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + prefetch_distance < order.size()) prefetch(&values[order[i + prefetch_distance]]);
    result.push_back(values[order[i]]);
  }
  return result;
}

}  // namespace rondel::system
