// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The order in which ties are broken.
#include "predicates/perturbation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/generators.h"
#include "support/oracle.h"

namespace rondel::predicates {
namespace {

mpz_class to_integer(std::uint64_t key) {
  return (mpz_class(static_cast<unsigned>(key >> 32)) << 32) + static_cast<unsigned>(key);
}

// Results with ties depend on these numbers: they never change.
TEST(lowering_key, is_fixed_for_ever) {
  EXPECT_EQ(lowering_key({1, 0, 0}), 0xfada530bcd0fd1d8U);
  EXPECT_EQ(lowering_key({0, 1, 0}), 0xf6aee76c18177ff5U);
  EXPECT_EQ(lowering_key({0, 0, -1}), 0x8f55431a3f11a750U);
  EXPECT_EQ(lowering_key({1, 2, 2}), 0xee3cada09ed6c81bU);
  EXPECT_EQ(lowering_key({0.1, -0.2, 5e-324}), 0xcaba41d3d2c89589U);
  EXPECT_EQ(lowering_key({1e300, -1e-300, 0.5}), 0xc5c56d30e3837accU);
}

TEST(lowering_key, is_that_of_the_definition) {
  test::Random random(31);
  const auto number = [&random] {
    switch (random.below(4)) {
      case 0:
        return static_cast<double>(random.between(-3, 3));
      case 1:
        return std::ldexp(random.signed_unit(), random.between(-1074, 1023));
      case 2:
        return std::ldexp(static_cast<double>(random.between(-9, 9)), -1074);
      default:
        return random.signed_unit();
    }
  };
  for (std::size_t i = 0; i < test::scaled(3000); ++i) {
    const Point p = {number(), number(), number()};
    EXPECT_EQ(to_integer(lowering_key(p)), test::hash_of_coordinates(p))
        << p.x << ' ' << p.y << ' ' << p.z;
  }
}

TEST(lowering_key, does_not_tell_zeros_apart) {
  EXPECT_EQ(lowering_key({-0.0, 1, -0.0}), lowering_key({0, 1, 0}));
  EXPECT_FALSE(is_lowered_more({-0.0, 1, -0.0}, {0, 1, 0}));
  EXPECT_FALSE(is_lowered_more({0, 1, 0}, {-0.0, 1, -0.0}));
}

TEST(is_lowered_more, is_the_order_of_the_keys) {
  EXPECT_TRUE(is_lowered_more({0, 0, -1}, {1, 2, 2}));
  EXPECT_TRUE(is_lowered_more({1, 2, 2}, {0, 1, 0}));
  EXPECT_TRUE(is_lowered_more({0, 1, 0}, {1, 0, 0}));
  EXPECT_FALSE(is_lowered_more({1, 0, 0}, {0, 1, 0}));
}

}  // namespace
}  // namespace rondel::predicates
