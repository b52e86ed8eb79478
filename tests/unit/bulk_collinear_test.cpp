// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which of three sites on one great circle is between the others: m = i a + j b is between a and b
// if i and j are positive, and in the triangle with the center if i + j <= 1 as well. All numbers
// are integers, so nothing is rounded.
#include <cmath>

#include "bulk/collinear.h"
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
    expect_between(random, 1 << 20, 1 << 20, {}, 1);  // too near for doubles
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

}  // namespace
}  // namespace rondel::test
