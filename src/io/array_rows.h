// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Walks over the rows of a box of an array.
//
// in    the lengths of the box and of the arrays
// out   the positions of the rows
// index dimensions of the array
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rondel::io {

using BoxLengths = std::vector<std::size_t>;

// Returns the distance of neighbors along each dimension of an array of these lengths, the last
// dimension of which varies fastest.
template <class Lengths>
BoxLengths steps_of(const Lengths& lengths) {
  BoxLengths steps(lengths.size(), 1);
  for (std::size_t d = lengths.size(); d-- > 1;) {
    steps[d - 1] = steps[d] * static_cast<std::size_t>(lengths[d]);
  }
  return steps;
}

// Returns the dimensions of an array in their own order.
inline BoxLengths own_order(std::size_t rank) {
  BoxLengths order(rank);
  for (std::size_t d = 0; d < rank; ++d) order[d] = d;
  return order;
}

// Calls visit(from, to) for the rows of a box along the last of the dimensions in `order`. `from`
// and `to` are the positions of a row's first value in two arrays, in which neighbors are
// `from_steps` and `to_steps` apart.
template <class Visit>
void for_each_row(const BoxLengths& count, std::span<const std::size_t> order,
                  std::span<const std::size_t> from_steps, std::span<const std::size_t> to_steps,
                  const Visit& visit) {
  BoxLengths at(order.size(), 0);
  std::size_t from = 0;
  std::size_t to = 0;
  for (;;) {
    visit(from, to);
    std::size_t w = order.size() - 1;
    for (;;) {
      if (w-- == 0) return;
      const std::size_t d = order[w];
      from += from_steps[d];
      to += to_steps[d];
      if (++at[w] < count[d]) break;
      from -= from_steps[d] * count[d];
      to -= to_steps[d] * count[d];
      at[w] = 0;
    }
  }
}

}  // namespace rondel::io
