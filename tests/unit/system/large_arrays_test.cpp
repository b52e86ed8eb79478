// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// system/large_arrays.h: memory of any size, and what users of vectors expect.
#include "system/large_arrays.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <new>
#include <numeric>
#include <tuple>
#include <utility>

#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel {
namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20;

TEST(large_vector, begins_with_a_huge_page_if_it_fills_one) {
  for (const std::size_t size : {huge_page, huge_page + 1, 3 * huge_page - 1}) {
    const LargeVector<std::uint8_t> values(size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(values.data()) % huge_page, 0U) << size;
  }
}

TEST(large_vector, begins_with_a_cache_line) {
  for (const std::size_t size :
       {std::size_t{1}, std::size_t{63}, std::size_t{1000}, huge_page - 1}) {
    const LargeVector<std::uint8_t> values(size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(values.data()) % 64, 0U) << size;
  }
}

TEST(large_vector, keeps_its_elements_while_it_grows_shrinks_and_moves) {
  LargeVector<Index> values;
  for (Index i = 0; i < huge_page; ++i) values.push_back(i);
  values.resize(huge_page / 2);
  values.shrink_to_fit();
  LargeVector<Index> copy = values;
  const LargeVector<Index> moved = std::move(values);
  EXPECT_EQ(copy, moved);
  EXPECT_NE(copy.data(), moved.data());
  copy.resize(copy.size() + 2, 7);
  LargeVector<Index> expected(huge_page / 2);
  std::iota(expected.begin(), expected.end(), Index{0});
  EXPECT_EQ(moved, expected);
  expected.insert(expected.end(), 2, 7);
  EXPECT_EQ(copy, expected);
}

TEST(large_vector, of_more_than_memory_can_hold_throws) {
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
  EXPECT_THROW(std::ignore = LargeAllocator<Triple>().allocate(most / 4), std::bad_alloc);
}

}  // namespace
}  // namespace rondel
