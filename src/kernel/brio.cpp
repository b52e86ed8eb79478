// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "kernel/brio.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "order/crowds.h"

namespace rondel::kernel {
namespace {

constexpr unsigned num_rounds = 11;  // 8^10 exceeds the number of sites

// The round of a rank, 0 being the last: the finalizer of MurmurHash3 spreads the bits.
unsigned round_of(Index rank) {
  std::uint32_t h = rank + 0x9e3779b9U;
  h = (h ^ (h >> 16)) * 0x85ebca6bU;
  h = (h ^ (h >> 13)) * 0xc2b2ae35U;
  h ^= h >> 16;
  return static_cast<unsigned>(std::countr_zero(h | (1U << 30))) / 3;
}

}  // namespace

std::vector<Index> insertion_order(Index n) {
  std::array<std::size_t, num_rounds + 1> begin{};
  for (Index i = 0; i < n; ++i) ++begin[num_rounds - round_of(i)];
  for (std::size_t r = 1; r <= num_rounds; ++r) begin[r] += begin[r - 1];
  std::vector<Index> order(n);
  for (Index i = 0; i < n; ++i) order[begin[num_rounds - 1 - round_of(i)]++] = i;
  return order;
}

std::vector<Index> insertion_order(std::span<const Point> sites, std::span<const Index> order,
                                   Model model, const Point& center) {
  auto insertion = insertion_order(static_cast<Index>(order.size()));
  const auto ranks = order::ranks_with_crowds_in_order(sites, order, model, center);
  if (!ranks.empty()) {
    for (Index& i : insertion) i = ranks[i];
  }
  return insertion;
}

}  // namespace rondel::kernel
