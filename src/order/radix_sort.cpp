// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "order/sorts.h"
#include "system/large_arrays.h"

namespace rondel::order {
namespace {

constexpr int digit_bits = 11;
constexpr std::size_t num_digits = std::size_t{1} << digit_bits;
constexpr int digits = 3;  // sorted at once

using DigitPositions = std::array<std::size_t, num_digits>;

std::size_t digit(std::uint64_t key, int shift) { return (key >> shift) & (num_digits - 1); }

// How many keys of the range have each digit, for all digits in one pass.
std::array<DigitPositions, digits> count_digits(const KeyedIndices& data, std::size_t first,
                                                std::size_t last, int lowest) {
  std::array<DigitPositions, digits> counts{};
  for (std::size_t i = first; i < last; ++i) {
    for (int d = 0; d < digits; ++d) {
      ++counts[static_cast<std::size_t>(d)][digit(data.keys[i], lowest + d * digit_bits)];
    }
  }
  return counts;
}

// Moves the range to `target`, stable by the digit at `shift`. Uses up the counts.
void move_by_digit(const KeyedIndices& data, KeyedIndices& target, std::size_t first,
                   std::size_t last, int shift, DigitPositions& position) {
  std::size_t sum = first;
  for (std::size_t& p : position) sum += std::exchange(p, sum);
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t at = position[digit(data.keys[i], shift)]++;
    target.keys[at] = data.keys[i];
    target.indices[at] = data.indices[i];
  }
}

// Sorts the range by three digits.
void sort_by_digits(KeyedIndices& data, KeyedIndices& buffer, std::size_t first, std::size_t last,
                    int lowest) {
  auto counts = count_digits(data, first, last, lowest);
  move_by_digit(data, buffer, first, last, lowest, counts[0]);
  move_by_digit(buffer, data, first, last, lowest + digit_bits, counts[1]);
  move_by_digit(data, buffer, first, last, lowest + 2 * digit_bits, counts[2]);
  if (last - first == data.keys.size()) {
    std::swap(data, buffer);
    return;
  }
  const auto begin = static_cast<std::ptrdiff_t>(first);
  const auto end = static_cast<std::ptrdiff_t>(last);
  std::copy(buffer.keys.begin() + begin, buffer.keys.begin() + end, data.keys.begin() + begin);
  std::copy(buffer.indices.begin() + begin, buffer.indices.begin() + end,
            data.indices.begin() + begin);
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
  const int rest = std::max(0, bits - digits * digit_bits);
  sort_by_digits(data, buffer, first, last, rest);
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
  system::reserve_large(buffer.keys, data.keys.size());
  system::reserve_large(buffer.indices, data.indices.size());
  buffer.keys.resize(data.keys.size());
  buffer.indices.resize(data.indices.size());
  sort_range(data, buffer, 0, data.keys.size(), bits);
}

}  // namespace rondel::order
