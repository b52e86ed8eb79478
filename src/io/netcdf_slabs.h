// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Divides successive values of an array into boxes, as netCDF-C reads and writes them.
//
// in    the shape of an array, and an interval of its values
// out   boxes that divide the interval
// index dimensions of the array; values with the last dimension varying fastest
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rondel::io {

// Calls visit(start, count, offset, size) for boxes that together are the values [begin, begin +
// size) of an array of this shape, whose last dimension varies fastest. A box has `count` indices
// along each dimension from `start` on; it has `size` values, the first of which is value `offset`
// of the interval. Each box is the largest possible one, so that at most 2 rank - 1 boxes are
// needed. Precondition: the values exist.
template <class Visit>
void for_each_slab(std::span<const std::uint64_t> shape, std::uint64_t begin, std::size_t size,
                   const Visit& visit) {
  const std::size_t rank = shape.size();
  std::vector<std::size_t> start(rank);
  std::vector<std::size_t> count(rank);
  std::size_t offset = 0;
  while (offset < size) {
    std::uint64_t rest = begin + offset;
    for (std::size_t d = rank; d-- > 0;) {
      start[d] = static_cast<std::size_t>(rest % shape[d]);
      rest /= shape[d];
      count[d] = 1;
    }
    // From the last dimension on, the box takes whole dimensions, as long as it begins with their
    // first index and all of them is wanted.
    std::size_t in_box = 1;
    for (std::size_t d = rank; d-- > 0;) {
      const auto left = static_cast<std::size_t>(shape[d]) - start[d];
      count[d] = std::min(left, (size - offset) / in_box);  // at least 1
      in_box *= count[d];
      if (start[d] != 0 || count[d] != shape[d]) break;
    }
    visit(start, count, offset, in_box);
    offset += in_box;
  }
}

}  // namespace rondel::io
