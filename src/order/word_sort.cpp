// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <utility>

#include "order/sorts.h"

namespace rondel::order {
namespace {

constexpr int max_bits = 11;
constexpr std::size_t small = 24;

void insertion_sort(std::span<std::uint64_t> words) {
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::uint64_t word = words[i];
    std::size_t j = i;
    for (; j > 0 && words[j - 1] > word; --j) words[j] = words[j - 1];
    words[j] = word;
  }
}

}  // namespace

// Words are dealt to as many cells as there are words, by the first bits in which they differ, then
// each crowded cell is treated likewise. What is left is nearly sorted: no word leaves its cell.
void sort_words(std::span<std::uint64_t> words, std::span<std::uint64_t> result) {
  if (words.size() <= small) {
    std::ranges::copy(words, result.begin());
    insertion_sort(result);
    return;
  }
  std::uint64_t differences = 0;
  for (const std::uint64_t word : words) differences |= word ^ words[0];
  if (differences == 0) {
    std::ranges::copy(words, result.begin());
    return;
  }
  const int agreed = std::countl_zero(differences);
  const int bits = std::min(max_bits, static_cast<int>(std::bit_width(words.size())));
  const std::size_t num_cells = std::size_t{1} << bits;
  const auto cell = [=](std::uint64_t word) { return word << agreed >> (64 - bits); };

  std::array<std::uint32_t, std::size_t{1} << max_bits> counts;
  std::fill_n(counts.begin(), num_cells, 0U);
  for (const std::uint64_t word : words) ++counts[cell(word)];
  std::uint32_t sum = 0;
  std::uint32_t most = 0;
  for (std::size_t c = 0; c < num_cells; ++c) {
    most = std::max(most, counts[c]);
    sum += std::exchange(counts[c], sum);
  }
  for (const std::uint64_t word : words) result[counts[cell(word)]++] = word;

  if (most > small) {
    for (std::size_t c = 0, begin = 0; c < num_cells; ++c) {
      const std::size_t end = counts[c];
      if (end - begin > small) {
        const auto crowd = result.subspan(begin, end - begin);
        const auto buffer = words.subspan(begin, end - begin);
        sort_words(crowd, buffer);
        std::ranges::copy(buffer, crowd.begin());
      }
      begin = end;
    }
  }
  insertion_sort(result);
}

}  // namespace rondel::order
