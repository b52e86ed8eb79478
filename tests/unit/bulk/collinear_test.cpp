// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The library finds which of three sites on one great circle is between the others: m = i a + j b
// is between a and b if i and j are positive, and in the triangle with the center if also i + j <=
// 1. All numbers are integers, so nothing is rounded.
#include "bulk/collinear.h"

#include <array>
#include <cmath>
#include <cstdint>

#include "exact/vector.h"
#include "gtest/gtest.h"
#include "support/random.h"

namespace rondel::test {
namespace {

using bulk::Between;

Between expected(int i, int j, int denominator) {
  if (i <= 0 || j <= 0) return Between::no;
  return i + j <= denominator ? Between::below : Between::yes;
}

Point random_point(Random& random, int most) {
  return {1.0 * random.between(-most, most), 1.0 * random.between(-most, most),
          1.0 * random.between(-most, most)};
}

bool are_parallel(const Point& a, const Point& b) {
  return a.y * b.z == a.z * b.y && a.z * b.x == a.x * b.z && a.x * b.y == a.y * b.x;
}

void expect_between(Random& random, int most, int nearness, const Point& center, double scale) {
  Point a = random_point(random, most);
  Point b = random_point(random, most);
  if (nearness > 1) b = nearness * a + b;
  if (are_parallel(a, b)) return;
  constexpr int denominator = 8;
  const int i = random.between(-12, 12);
  const int j = random.between(-12, 12);
  if (i <= 0 && j <= 0) return;  // in no half plane, or the center
  const Point m = i * a + j * b;
  const auto place = [&](const Point& p) { return center + scale * p; };
  const Between between =
      bulk::is_between(place(denominator * a), place(m), place(denominator * b), place({}));
  EXPECT_EQ(between, expected(i, j, denominator)) << i << ' ' << j;
}

TEST(bulk_collinear, middle_of_three_sites) {
  Random random(71);
  for (int k = 0; k < 20000; ++k) {
    expect_between(random, 3, 1, {}, 1);
    expect_between(random, 1000, 1, {}, 1);
    expect_between(random, 1000, 1, {1e6, -3e5, 7e5}, 1);
    expect_between(random, 1 << 20, 1 << 20, {}, 1);  // close together
    expect_between(random, 1000, 1 << 20, {}, 1);
  }
}

// Where lengths or products of doubles overflow or lose bits.
TEST(bulk_collinear, middle_of_three_sites_at_any_scale) {
  Random random(72);
  for (int k = 0; k < 300; ++k) {
    for (const int exponent : {-1060, -600, -540, -300, -270, 250, 300, 500, 990}) {
      expect_between(random, 100, 1, {}, std::ldexp(1.0, exponent));
    }
  }
}

// Near each other, and with differences from the center that no double holds: in a plane x = const,
// with integers in units of 2^-60.
TEST(bulk_collinear, middle_of_three_sites_that_doubles_cannot_tell_apart) {
  using Integer = __int128;
  struct Ray {
    std::int64_t y, z;
  };
  const auto turn = [](const Ray& a, const Ray& b) {
    const Integer value = Integer{a.y} * b.z - Integer{a.z} * b.y;
    return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0);
  };
  const auto minus = [](const Ray& a, const Ray& b) { return Ray{a.y - b.y, a.z - b.z}; };
  Random random(73);
  int num_between = 0;
  for (int k = 0; k < 20000; ++k) {
    const Ray center = {random.between(-1000000, 1000000), random.between(-1000000, 1000000)};
    const std::int64_t ulp = std::int64_t{1} << 8;
    const Ray first = {(std::int64_t{1} << 60) + ulp * random.between(0, 1 << 20),
                       (std::int64_t{1} << 60) + ulp * random.between(0, 1 << 20)};
    std::array<Ray, 3> rays{};
    std::array<Point, 3> points;
    for (std::size_t i = 0; i < 3; ++i) {
      const Ray p = {first.y + ulp * random.between(-4, 4), first.z + ulp * random.between(-4, 4)};
      rays[i] = minus(p, center);
      points[i] = {1, std::ldexp(static_cast<double>(p.y), -60),
                   std::ldexp(static_cast<double>(p.z), -60)};
    }
    const auto& [a, m, b] = rays;
    const int all = turn(a, b);
    if (all == 0) continue;
    Between between = Between::no;
    if (turn(a, m) * all > 0 && turn(m, b) * all > 0) {
      between = turn(minus(m, a), minus(b, a)) * all > 0 ? Between::yes : Between::below;
      ++num_between;
    }
    const Point c = {1, std::ldexp(static_cast<double>(center.y), -60),
                     std::ldexp(static_cast<double>(center.z), -60)};
    EXPECT_EQ(bulk::is_between(points[0], points[1], points[2], c), between);
  }
  EXPECT_GT(num_between, 1000);
}

}  // namespace
}  // namespace rondel::test
