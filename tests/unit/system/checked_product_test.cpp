// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "system/checked_product.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace rondel::test {
namespace {

// All pairs of bytes, whose products and sums integers hold.
TEST(checked_product, knows_what_fits_into_a_byte) {
  for (unsigned a = 0; a < 256; ++a) {
    for (unsigned b = 0; b < 256; ++b) {
      const auto first = static_cast<std::uint8_t>(a);
      const auto second = static_cast<std::uint8_t>(b);
      std::uint8_t product = 77;
      std::uint8_t sum = 77;
      ASSERT_EQ(system::multiply_checked(first, second, product), a * b < 256);
      ASSERT_EQ(system::add_checked(first, second, sum), a + b < 256);
      ASSERT_EQ(product, a * b < 256 ? a * b : 77U);
      ASSERT_EQ(sum, a + b < 256 ? a + b : 77U);
    }
  }
}

TEST(checked_product, may_be_one_of_the_factors) {
  std::uint64_t product = 1;
  for (int i = 0; i < 63; ++i) ASSERT_TRUE(system::multiply_checked(product, 2, product));
  EXPECT_EQ(product, std::uint64_t{1} << 63U);
  EXPECT_FALSE(system::multiply_checked(product, 2, product));
  EXPECT_EQ(product, std::uint64_t{1} << 63U);
}

}  // namespace
}  // namespace rondel::test
