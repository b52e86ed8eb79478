// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Both ways to write a double give the same text.

#include "system/message_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace rondel::system {
namespace {

void expect_same(double value) {
  EXPECT_EQ(shortest_text_without_tables(value), shortest_text(value));
  EXPECT_EQ(shortest_text_without_tables(-value), shortest_text(-value));
}

TEST(shortest_text, is_the_same_without_tables) {
  for (const double value :
       {0.0, 0.1, 1.0, 95.2, 1e5, 100001.0, 123456.0, 1e21, 1e23, 1e-4, 1.5e-5, 1e-7, 1.0 / 3,
        12345678901234567000.0, 0x1p-1074, std::numeric_limits<double>::max(),
        std::numeric_limits<double>::infinity(), std::nan("")}) {
    expect_same(value);
  }
}

TEST(shortest_text, is_the_same_for_doubles_of_all_magnitudes) {
  std::mt19937_64 random(1);  // NOLINT(bugprone-random-generator-seed): the same each time
  for (int i = 0; i < 20'000; ++i) {
    expect_same(std::bit_cast<double>(std::uint64_t{random()}));
    expect_same(
        std::ldexp(static_cast<double>(random() >> 40), static_cast<int>(random() % 60) - 50));
  }
}

TEST(shortest_text, of_a_few_numbers) {
  EXPECT_EQ(shortest_text_without_tables(95.2), "95.2");
  EXPECT_EQ(shortest_text_without_tables(100000), "1e+05");
  EXPECT_EQ(shortest_text_without_tables(-0.0), "-0");
}

}  // namespace
}  // namespace rondel::system
