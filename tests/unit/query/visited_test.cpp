// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The set of what a query has visited.

#include "query/visited.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>

#include "support/random.h"

namespace rondel::test {
namespace {

// Counts how many slots are written after they were made.
struct CountingStamp {
  constexpr CountingStamp() = default;
  constexpr explicit CountingStamp(std::uint32_t n) : number(n) {}
  CountingStamp(const CountingStamp&) = default;
  CountingStamp& operator=(const CountingStamp& other) {
    number = other.number;
    ++num_written;
    return *this;
  }
  CountingStamp& operator++() {
    ++number;
    return *this;
  }
  friend bool operator==(const CountingStamp&, const CountingStamp&) = default;

  std::uint32_t number = 0;
  static inline std::size_t num_written = 0;
};

TEST(query_visited, a_small_query_after_a_large_one_writes_what_it_visits) {
  query::StampedSet<CountingStamp> visited;
  for (Index i = 0; i < 100'000; ++i) visited.insert(i);
  CountingStamp::num_written = 0;
  for (int query = 0; query < 1000; ++query) {
    visited.clear();
    for (Index i = 0; i < 7; ++i) EXPECT_TRUE(visited.insert(i));
    for (Index i = 0; i < 7; ++i) EXPECT_FALSE(visited.insert(i));
  }
  EXPECT_EQ(CountingStamp::num_written, 7U * 1000U);
}

// With stamps of eight bits, so that all of them are used up more than once.
TEST(query_visited, holds_what_was_inserted_since_it_was_cleared) {
  query::StampedSet<std::uint8_t> visited;
  Random random(5);
  for (int query = 0; query < 1000; ++query) {
    visited.clear();
    std::set<Index> expected;
    const int size = query % 50 == 0 ? 1000 : random.between(0, 40);
    for (int i = 0; i < size; ++i) {
      const auto value = static_cast<Index>(random.between(0, size));
      EXPECT_EQ(visited.insert(value), expected.insert(value).second);
    }
  }
}

TEST(query_visited, holds_nothing_after_any_number_of_clears) {
  for (int num_clears = 1; num_clears < 600; ++num_clears) {
    query::StampedSet<std::uint8_t> visited;
    visited.insert(7);
    for (int i = 0; i < num_clears; ++i) visited.clear();
    EXPECT_TRUE(visited.insert(7)) << num_clears;
    EXPECT_FALSE(visited.insert(7)) << num_clears;
  }
}

TEST(query_visited, takes_every_index) {
  query::VisitedSet visited;
  EXPECT_TRUE(visited.insert(no_index));
  EXPECT_TRUE(visited.insert(0));
  EXPECT_FALSE(visited.insert(no_index));
  EXPECT_FALSE(visited.insert(0));
}

}  // namespace
}  // namespace rondel::test
