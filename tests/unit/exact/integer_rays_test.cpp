// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sides of circles in integers of the machine, which an oracle computes with GMP and MPFR.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "exact/integer_signs.h"
#include "support/generators.h"
#include "support/oracle.h"

namespace rondel::test {
namespace {

using Rays = std::array<Point, 4>;

bool has_integer_rays() {
  return exact::side_of_rays_in_integers({{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}}, {})
      .has_value();
}

// What the integers know is what the oracle says. Returns whether they know.
bool expect_side_of_oracle(const Rays& rays, const Point& center = {}) {
  const auto side = exact::side_of_rays_in_integers(rays, center);
  const Oracle oracle(rays, Model::projected, {center});
  const int expected = oracle.side_of_circle(0, 1, 2, 3);
  if (side) {
    EXPECT_EQ(static_cast<int>(*side), expected);
  } else {
    EXPECT_NE(expected, 0) << "a tie of integers below 2^60";
  }
  return side.has_value();
}

double integer(Random& random, std::size_t most) {
  return static_cast<double>(random.below(2 * most + 1)) - static_cast<double>(most);
}

// On the cone around an axis whose slope is h: a^2 - b^2, 2ab and a^2 + b^2 are sides of a right
// triangle. Lengths are as different as the multiples.
Point on_cone(Random& random, double h, unsigned axis) {
  const double a = integer(random, 1 << 20) + 0.5;
  const double b = integer(random, 1 << 20);
  const double factor =
      std::ldexp(static_cast<double>(1 + 2 * random.below(7)), static_cast<int>(random.below(60)));
  const Point p = {factor * (a * a - b * b), factor * (2 * a * b), factor * (h * (a * a + b * b))};
  if (axis == 0) return p;
  return axis == 1 ? Point{p.y, p.z, p.x} : Point{p.z, p.x, p.y};
}

TEST(integer_rays, know_ties_of_rays_of_any_lengths) {
  if (!has_integer_rays()) GTEST_SKIP() << "no integers of 128 bits";
  Random random(1);
  for (unsigned i = 0; i < 1000; ++i) {
    const double h = 0.25 * integer(random, 8);
    Rays rays;
    for (Point& p : rays) p = on_cone(random, h, i % 3);
    EXPECT_EQ(exact::side_of_rays_in_integers(rays, {}), Sign::zero);
    if (i < 20) {
      EXPECT_TRUE(expect_side_of_oracle(rays));
    }
  }
}

TEST(integer_rays, know_ties_around_any_center) {
  if (!has_integer_rays()) GTEST_SKIP() << "no integers of 128 bits";
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Point center = {integer(random, 1000), integer(random, 1000), integer(random, 1000)};
    Rays rays;
    for (Point& p : rays) {
      const double a = integer(random, 1 << 20) + 0.5;
      const double b = integer(random, 1 << 20);
      p = {center.x + (a * a - b * b), center.y + 2 * a * b, center.z + 0.75 * (a * a + b * b)};
    }
    EXPECT_EQ(exact::side_of_rays_in_integers(rays, center), Sign::zero);
    rays[3].z = std::nextafter(rays[3].z, 0);
    expect_side_of_oracle(rays, center);
  }
}

TEST(integer_rays, know_what_is_next_to_a_tie_or_say_nothing) {
  Random random(2);
  for (unsigned i = 0; i < 300; ++i) {
    Rays rays;
    for (Point& p : rays) p = on_cone(random, 1.75, i % 3);
    double& x = i % 2 == 0 ? rays[i % 4].x : rays[i % 4].z;
    x = std::nextafter(x, 0);
    expect_side_of_oracle(rays);
  }
}

// Short vectors have all kinds of ties: determinants of 0, equal lengths, one class or two.
TEST(integer_rays, know_all_ties_of_short_vectors) {
  if (!has_integer_rays()) GTEST_SKIP() << "no integers of 128 bits";
  Random random(3);
  std::size_t ties = 0;
  std::size_t known = 0;
  for (int i = 0; i < 20000; ++i) {
    Rays rays;
    for (Point& p : rays) {
      do p = {integer(random, 2), integer(random, 2), integer(random, 2)};
      while (p == Point{});
    }
    const auto side = exact::side_of_rays_in_integers(rays, {});
    if (side) ++known;
    if (side == Sign::zero) ++ties;
    expect_side_of_oracle(rays);
  }
  EXPECT_GT(ties, 1000U);
  EXPECT_GT(known, ties + 1000);
  EXPECT_LT(known, 20000U);
  // Two classes, each with a sum of 0: sqrt(2) and 1.
  EXPECT_TRUE(expect_side_of_oracle({{{3, 3, 0}, {-1, 1, 0}, {0, 0, 2}, {0, 0, -5}}}));
  EXPECT_TRUE(expect_side_of_oracle({{{3, 4, 12}, {-6, 8, 24}, {-9, -12, 36}, {12, -16, 48}}}));
}

// Every product and sum that may come close to the ends of the range does.
TEST(integer_rays, do_not_overflow_at_the_longest_coordinates) {
  const double most = 0x1p60 - 0x1p7;
  Random random(4);
  for (const int power : {0, -700, 900}) {
    for (unsigned i = 0; i < 4096; i += power == 0 ? 1 : 7) {
      Rays rays;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto corner = [&](std::size_t axis) {
          const double end = (i >> (3 * k + axis) & 1U) == 0 ? -most : most;
          return std::ldexp(end + (end < 0 ? 0x1p7 : -0x1p7) * static_cast<double>(random.below(2)),
                            power);
        };
        rays[k] = {corner(0), corner(1), corner(2)};
      }
      const double end = std::ldexp(most, power);
      const Point corner = {-end, end, -end};
      if (std::ranges::find(rays, corner) == rays.end()) {
        expect_side_of_oracle(rays, corner);
      }
      expect_side_of_oracle(rays);
    }
  }
}

TEST(integer_rays, say_nothing_of_coordinates_that_are_no_integers_below_60_bits) {
  const auto with = [](double x, double y) {
    return Rays{{{x, y, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}};
  };
  EXPECT_EQ(exact::side_of_rays_in_integers(with(1, 0), {}).has_value(), has_integer_rays());
  EXPECT_EQ(exact::side_of_rays_in_integers(with(0x1p59, 1), {}).has_value(), has_integer_rays());
  EXPECT_FALSE(exact::side_of_rays_in_integers(with(0x1p60, 1), {}));
  EXPECT_FALSE(exact::side_of_rays_in_integers(with(0x1p1000, 0x1p-900), {}));
  EXPECT_FALSE(exact::side_of_rays_in_integers(with(0x1p-1000, 0), {}));
}

}  // namespace
}  // namespace rondel::test
