// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Areas to the left of rings that are known by formulas: octants, lunes, and triangles with a right angle.
#include "map/ring_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace rondel::test::of_ring_area {
namespace {

using Corners = std::vector<Point>;
constexpr double pi = std::numbers::pi;

Corners backward(Corners ring) {
  std::ranges::reverse(ring);
  return ring;
}

// Expects an area whichever corner comes first, and its negative for the corners in reverse order. The error is that of
// angles of large rings.
void expect_area(Corners ring, double area, double error = 1e-14) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    EXPECT_NEAR(map::area_on_left(ring), area, error) << k;
    EXPECT_NEAR(map::area_on_left(backward(ring)), -area, error) << k;
    EXPECT_EQ(map::is_clockwise(ring), area < 0) << k;
    EXPECT_EQ(map::is_clockwise(backward(ring)), area > 0) << k;
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
  }
}

TEST(ring_area, of_octants) {
  const Point x{1, 0, 0};
  const Point y{0, 1, 0};
  const Point z{0, 0, 1};
  const Point west{-1, 0, 0};
  const Point south{0, -1, 0};
  expect_area({x, y, z}, pi / 2);
  expect_area({x, y, west, z}, pi);
  expect_area({x, y, west, south, z}, 3 * pi / 2);
}

// A lune between two meridians, from pole to pole, has twice its angle.
TEST(ring_area, of_lunes) {
  for (const double angle : {1e-9, 0.1, 1.0, 2.0, 3.0}) {
    const Point end{std::cos(angle), std::sin(angle), 0};
    expect_area({{0, 0, -1}, end, {0, 0, 1}, {1, 0, 0}}, 2 * angle);
  }
}

// With a right angle between sides a and b the tangent of half the area is that of a / 2 times that of b / 2.
TEST(ring_area, of_right_triangles) {
  for (const double a : {1e-8, 1e-4, 0.1, 0.8, 1.5, 2.5}) {
    for (const double b : {1e-8, 0.01, 0.5, 1.04, 1.06, 2.0}) {
      const Corners ring = {
          {1, 0, 0}, {std::cos(a), std::sin(a), 0}, {std::cos(b), 0, std::sin(b)}};
      const double area = 2 * std::atan(std::tan(a / 2) * std::tan(b / 2));
      // Of small rings no digits are lost.
      expect_area(ring, area, std::max(a, b) < 1 ? 1e-14 * area : 1e-14);
    }
  }
}

TEST(ring_area, of_what_goes_back_on_itself_is_nothing) {
  const Point x{1, 0, 0};
  const Point near{0.8, 0.6, 0};
  const Point far{0, 1, 0};
  EXPECT_EQ(map::area_on_left(Corners{x, near}), 0);
  EXPECT_EQ(map::area_on_left(Corners{x, far}), 0);
  EXPECT_EQ(map::area_on_left(Corners{x, near, x, near}), 0);
  EXPECT_EQ(map::area_on_left(Corners{x, far, near, far}), 0);
  EXPECT_FALSE(map::is_clockwise(Corners{x, far, near, far}));
}

// In a sum of doubles, each of the small areas would be lost beside the large one.
TEST(ring_area, sums_keep_small_areas) {
  constexpr double leg = 1e-9;
  std::vector<Corners> rings(20'001, {{1, 0, 0}, {1, leg, 0}, {1, 0, leg}});
  rings[0] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double sum = map::areas_on_left(rings);
  EXPECT_NEAR(sum - pi / 2, 20'000 * leg * leg / 2, 5e-16);
  std::ranges::reverse(rings);
  EXPECT_EQ(map::areas_on_left(rings), sum);
  EXPECT_EQ(map::areas_on_left(std::vector<Corners>{}), 0);
}

// Squares of corners at a distance from their center: the answer is true for some less than the area, and only if all
// triangles at the first corner turn one way and no corner is far.
TEST(ring_area, is_surely_larger_than_a_part_of_it) {
  for (const double radius : {0.001, 0.2, 0.5}) {
    const double s = std::sin(radius);
    const double c = std::cos(radius);
    const Corners square = {{c, s, 0}, {c, 0, s}, {c, -s, 0}, {c, 0, -s}};
    const double area = map::area_on_left(square);
    for (const Corners& ring : {square, backward(square)}) {
      EXPECT_TRUE(map::is_surely_larger(ring, area / 20)) << radius;
      EXPECT_FALSE(map::is_surely_larger(ring, area)) << radius;
    }
    const Corners bow = {square[0], square[1], square[3], square[2]};
    EXPECT_FALSE(map::is_surely_larger(bow, 0)) << radius;
  }
  EXPECT_FALSE(map::is_surely_larger(Corners{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0.01));
}

// Stars of many corners, whose triangles turn both ways.
TEST(ring_area, is_surely_larger_for_many_corners) {
  for (const double radius : {1e-9, 0.001, 0.1}) {
    for (const int tips : {6, 20, 50}) {
      Corners star;
      for (int k = 0; k < 2 * tips; ++k) {
        const double angle = pi * k / tips;
        const double away = k % 2 == 0 ? radius : 0.6 * radius;
        star.push_back(
            {std::cos(away), std::sin(away) * std::cos(angle), std::sin(away) * std::sin(angle)});
      }
      const double area = std::abs(map::area_on_left(star));
      for (const Corners& ring : {star, backward(star)}) {
        EXPECT_TRUE(map::is_surely_larger(ring, area / 20)) << radius << ' ' << tips;
        EXPECT_FALSE(map::is_surely_larger(ring, area)) << radius << ' ' << tips;
      }
      // There and back is no area.
      Corners back = star;
      back.insert(back.end(), star.rbegin(), star.rend());
      EXPECT_FALSE(map::is_surely_larger(back, 0)) << radius << ' ' << tips;
      // A corner that is far away may make the area any.
      Corners wide = star;
      wide[3] = {0, 1, 0};
      EXPECT_FALSE(map::is_surely_larger(wide, area / 20)) << radius << ' ' << tips;
    }
  }
}

}  // namespace
}  // namespace rondel::test::of_ring_area
