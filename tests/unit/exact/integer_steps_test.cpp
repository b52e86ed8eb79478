// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Signs of determinants in integers of the machine, which GMP computes with rational numbers.
#include "exact/integer_steps.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "support/generators.h"

namespace rondel::test {
namespace {

using Corners = std::array<Point, 4>;  // o, a, b, c

std::optional<Sign> volume_in_integers(const Corners& q) {
  return exact::sign_of_volume_in_integers(q[0], q[1], q[2], q[3]);
}

int sign_by_gmp(const Corners& q) {
  std::array<std::array<mpq_class, 3>, 3> v;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = {mpq_class(q[i + 1].x) - mpq_class(q[0].x), mpq_class(q[i + 1].y) - mpq_class(q[0].y),
            mpq_class(q[i + 1].z) - mpq_class(q[0].z)};
  }
  const mpq_class value = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
                          v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
                          v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
  return sgn(value);
}

// Whether the compiler has the integers that it takes.
bool is_available() { return volume_in_integers({}).has_value(); }

// Returns whether the integers know.
bool expect_no_other_sign(const Corners& q) {
  const std::optional<Sign> sign = volume_in_integers(q);
  if (sign) {
    EXPECT_EQ(static_cast<int>(*sign), sign_by_gmp(q));
  }
  return sign.has_value();
}

TEST(integer_steps, know_the_signs_of_neighbors_in_a_mesh) {
  Random random(1);
  std::size_t known = 0;
  for (int i = 0; i < 2000; ++i) {
    Corners q;
    q[0] = random_direction(random);
    for (std::size_t k = 1; k < 4; ++k) q[k] = random_near(random, q[0], std::ldexp(1, -(i % 50)));
    if (expect_no_other_sign(q)) ++known;
    // In one plane with the last three, bit for bit.
    for (Point& p : q) p.x = p.y;
    EXPECT_EQ(volume_in_integers(q).value_or(Sign::zero), Sign::zero);
  }
  EXPECT_TRUE(known > 1500 || !is_available());
}

// Every product and sum that may come close to the ends of the range does.
TEST(integer_steps, do_not_overflow_at_the_longest_coordinates) {
  const double most = 0x1p60 - 0x1p7;
  Random random(2);
  for (int power : {0, -700, 900}) {
    for (int i = 0; i < 4096; ++i) {
      Corners q;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto corner = [&](std::size_t axis) {
          const double end = (static_cast<unsigned>(i) >> (3 * k + axis) & 1U) == 0 ? -most : most;
          const auto step = static_cast<double>(random.below(3)) * (end < 0 ? 0x1p7 : -0x1p7);
          return std::ldexp(end + step, power);
        };
        q[k] = {corner(0), corner(1), corner(2)};
      }
      ASSERT_TRUE(expect_no_other_sign(q) || !is_available());
    }
  }
}

// The determinant is 1, -1 or 0 next to products of 2^180.
TEST(integer_steps, see_the_last_bit) {
  constexpr double n = 0x1p52;
  for (const double off : {-1.0, 0.0, 1.0}) {
    // det of rows (n, n+1, 0), (n-1, n, 0), (0, 0, off) is off.
    const Corners q = {{{0, 0, 0}, {n, n + 1, 0}, {n - 1, n, 0}, {n, n, off}}};
    EXPECT_EQ(sign_by_gmp(q), static_cast<int>(off));
    EXPECT_TRUE(expect_no_other_sign(q) || !is_available());
  }
}

TEST(integer_steps, know_what_is_a_multiple_of_one_unit_below_60_bits) {
  if (!is_available()) GTEST_SKIP() << "no integers of 128 bits";
  const auto with = [](double longest, double other) {
    return Corners{{{longest, 0, 0}, {other, 1, 0}, {0, 0, 1}, {0, 1, 1}}};
  };
  EXPECT_TRUE(expect_no_other_sign(with(0x1p59, 1)));
  EXPECT_TRUE(expect_no_other_sign(with(0x1p60 - 0x1p7, 1)));
  EXPECT_FALSE(volume_in_integers(with(0x1p59, 0.5)));
  EXPECT_FALSE(volume_in_integers(with(0x1p60, 1)));
  // What becomes 0 next to it in any unit.
  EXPECT_FALSE(volume_in_integers(with(0x1p1000, 0x1p-900)));
  EXPECT_FALSE(volume_in_integers(with(-0x1p60, 1 + 0x1p-52)));
}

// An axis along which all are 0 is one; a unit must be a number that a power of two reaches.
TEST(integer_steps, know_zeros_and_large_coordinates_but_no_tiny_ones) {
  if (!is_available()) GTEST_SKIP() << "no integers of 128 bits";
  EXPECT_EQ(volume_in_integers({{{1, 0, 0}, {0, 1, 0}, {-1, 0.5, -0.0}, {3, 4, 0}}}), Sign::zero);
  const auto scaled = [](double size) {
    return Corners{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}}};
  };
  for (const double size : {0x1p-963, 1.0, std::numeric_limits<double>::max()}) {
    EXPECT_EQ(volume_in_integers(scaled(size)), Sign::positive);
  }
  for (const double size : {0x1p-964, 0x1p-1022, std::numeric_limits<double>::denorm_min()}) {
    EXPECT_FALSE(volume_in_integers(scaled(size)));
  }
}

}  // namespace
}  // namespace rondel::test
