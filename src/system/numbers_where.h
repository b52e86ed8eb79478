// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers that have a property, found by several threads.
#pragma once

#include <cstddef>
#include <vector>

#include "rondel/types.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::system {

// Returns the numbers i < count for which is_wanted(i) is true, ascending. It is called up to twice
// for each number.
template <class Wanted>
std::vector<Index> numbers_where(unsigned threads, std::size_t count, const Wanted& is_wanted) {
  constexpr std::size_t grain = 4096;
  if (count <= grain) {
    std::vector<Index> few;
    for (std::size_t i = 0; i < count; ++i) {
      if (is_wanted(i)) few.push_back(static_cast<Index>(i));
    }
    return few;
  }
  std::vector<std::size_t> offsets(num_pieces(count, grain) + 1, 0);
  parallel_for(threads, count, grain, [&](std::size_t begin, std::size_t end) {
    std::size_t wanted = 0;
    for (std::size_t i = begin; i < end; ++i) wanted += is_wanted(i) ? 1 : 0;
    offsets[begin / grain + 1] = wanted;
  });
  sum_counts(offsets);
  std::vector<Index> numbers(offsets.back());
  parallel_for(threads, count, grain, [&](std::size_t begin, std::size_t end) {
    std::size_t next = offsets[begin / grain];
    for (std::size_t i = begin; i < end; ++i) {
      if (is_wanted(i)) numbers[next++] = static_cast<Index>(i);
    }
  });
  return numbers;
}

}  // namespace rondel::system
