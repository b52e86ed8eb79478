// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "blocks/radix_sort.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace rondel::blocks {
namespace {

constexpr int digit_bits = 11;
constexpr std::size_t num_digits = std::size_t{1} << digit_bits;

// Between `first` and `last`, stable by the digit at `shift`, through the buffers.
void sort_by_digit(KeyedIndices& data, KeyedIndices& buffer, std::size_t first, std::size_t last,
                   int shift) {
  std::array<std::size_t, num_digits> position{};
  const auto digit = [shift](std::uint64_t key) { return (key >> shift) & (num_digits - 1); };
  for (std::size_t i = first; i < last; ++i) ++position[digit(data.keys[i])];
  std::size_t sum = first;
  for (std::size_t& p : position) {
    const std::size_t count = p;
    p = sum;
    sum += count;
  }
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t target = position[digit(data.keys[i])]++;
    buffer.keys[target] = data.keys[i];
    buffer.indices[target] = data.indices[i];
  }
  std::copy(buffer.keys.begin() + static_cast<std::ptrdiff_t>(first),
            buffer.keys.begin() + static_cast<std::ptrdiff_t>(last),
            data.keys.begin() + static_cast<std::ptrdiff_t>(first));
  std::copy(buffer.indices.begin() + static_cast<std::ptrdiff_t>(first),
            buffer.indices.begin() + static_cast<std::ptrdiff_t>(last),
            data.indices.begin() + static_cast<std::ptrdiff_t>(first));
}

void insertion_sort(KeyedIndices& data, std::size_t first, std::size_t last) {
  for (std::size_t i = first + 1; i < last; ++i) {
    const std::uint64_t key = data.keys[i];
    const Index index = data.indices[i];
    std::size_t j = i;
    for (; j > first && data.keys[j - 1] > key; --j) {
      data.keys[j] = data.keys[j - 1];
      data.indices[j] = data.indices[j - 1];
    }
    data.keys[j] = key;
    data.indices[j] = index;
  }
}

// The keys of the range agree above `bits`. Sorts by their highest three digits, then each run of
// sites that agree in these: spread-out sites need no more than that.
void sort_range(KeyedIndices& data, KeyedIndices& buffer, std::size_t first, std::size_t last,
                int bits) {
  constexpr std::size_t small = 32;
  if (last - first <= small) {
    insertion_sort(data, first, last);
    return;
  }
  constexpr int digits = 3;
  const int rest = std::max(0, bits - digits * digit_bits);
  for (int shift = rest; shift < bits; shift += digit_bits) {
    sort_by_digit(data, buffer, first, last, shift);
  }
  if (rest == 0) return;
  for (std::size_t i = first; i < last;) {
    std::size_t end = i + 1;
    while (end < last && data.keys[end] >> rest == data.keys[i] >> rest) ++end;
    if (end - i > 1) sort_range(data, buffer, i, end, rest);
    i = end;
  }
}

}  // namespace

void radix_sort(KeyedIndices& data, int bits) {
  KeyedIndices buffer;
  buffer.keys.resize(data.keys.size());
  buffer.indices.resize(data.indices.size());
  sort_range(data, buffer, 0, data.keys.size(), bits);
}

}  // namespace rondel::blocks
