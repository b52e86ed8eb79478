// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// CornerTree finds the corners in a box, and Snaps divides sides at the corners that are on them but for rounding.
//
//               3                        Corner 2 is next to the side from 0 to 1 of cell A, which becomes two sides.
//              / \  B
//       0 ----- 2 ----- 1
//               A
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "overlay/corner_tree.h"
#include "overlay/snapped_sides.h"
#include "support/random.h"

namespace rondel::test::of_snaps {
namespace {

using overlay::OwnedSide;
using overlay::Snaps;
using Sides = std::vector<OwnedSide>;

// Whole numbers make many corners equal in a coordinate, and lie on the sides of boxes.
TEST(corner_tree, finds_what_a_look_at_all_corners_finds) {
  Random random(85);
  for (std::size_t n = 0; n < 120; n += 3) {
    std::vector<Point> points(n + 5);
    const auto coordinate = [&] { return static_cast<double>(random.below(7)); };
    for (Point& p : points) p = {coordinate(), coordinate(), coordinate()};
    std::vector<Index> corners(n);  // the others are in no list
    std::iota(corners.begin(), corners.end(), Index{5});
    random.shuffle(corners);
    const overlay::CornerTree tree(points, corners);
    for (int box = 0; box < 20; ++box) {
      const Point low{coordinate(), coordinate(), coordinate()};
      const Point high{low.x + coordinate() / 2, low.y + coordinate() / 2,
                       low.z + coordinate() / 2};
      std::vector<Index> found;
      tree.visit(low, high, [&](Index corner) { found.push_back(corner); });
      std::ranges::sort(found);
      std::vector<Index> expected;
      for (std::size_t i = 5; i < points.size(); ++i) {
        const Point& p = points[i];
        if (p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z &&
            p.z <= high.z)
          expected.push_back(static_cast<Index>(i));
      }
      EXPECT_EQ(found, expected) << n;
    }
  }
}

// A point of the equator at this share of the way from (1, 0, 0) to (0, 1, 0), and this far to the north.
Point beside_equator(double share, double north = 0) {
  const double angle = share * std::acos(0.0);
  return normalized(Point{std::cos(angle), std::sin(angle), north});
}

constexpr Index a = 7;  // owners
constexpr Index b = 8;
constexpr double near = 1e-15;

TEST(snaps, divide_a_side_at_a_corner_on_it) {
  const std::vector<Point> points = {
      beside_equator(0), beside_equator(1), beside_equator(0.4, near), {0, 0, 1}};
  for (const bool is_forward : {true, false}) {
    const OwnedSide side = is_forward ? OwnedSide{0, 1, a} : OwnedSide{1, 0, a};
    const Sides sides = {side, {2, 3, b}, {3, 2, b}};
    const Snaps snaps(points, sides);
    EXPECT_FALSE(snaps.is_empty());
    EXPECT_TRUE(snaps.would_change(sides));
    EXPECT_FALSE(snaps.would_change(Sides{{2, 3, b}}));
    EXPECT_EQ(snaps.applied(Sides{side}),
              is_forward ? (Sides{{0, 2, a}, {2, 1, a}}) : (Sides{{2, 0, a}, {1, 2, a}}));
    // The sides of b lead there and back.
    EXPECT_EQ(snaps.applied(sides).size(), 2U);
  }
}

TEST(snaps, leave_corners_farther_away_than_the_distance) {
  for (const double north : {1e-14, -1e-14, 0.1}) {
    const std::vector<Point> points = {beside_equator(0), beside_equator(1),
                                       beside_equator(0.4, north)};
    const Sides sides = {{0, 1, a}, {1, 2, a}, {2, 0, a}};
    EXPECT_TRUE(Snaps(points, sides).is_empty());
    EXPECT_EQ(Snaps(points, sides, 2e-14).is_empty(), north == 0.1);
  }
  // Corners on the circle of the side, but not on the side.
  for (const double share : {-0.1, 1.1, 2.0, 2.4, 3.0}) {
    const std::vector<Point> points = {
        beside_equator(0), beside_equator(1), beside_equator(share), {0, 0, 1}};
    EXPECT_TRUE(Snaps(points, Sides{{0, 1, a}, {2, 3, b}}).is_empty()) << share;
  }
}

// Corners are in their order along the side, whatever their numbers.
TEST(snaps, divide_a_side_at_several_corners) {
  std::vector<Point> points = {beside_equator(0),         beside_equator(1),
                               beside_equator(0.7, near), beside_equator(0.2, -near),
                               beside_equator(0.5),       {0, 0, 1}};
  const Sides others = {{2, 5, b}, {3, 5, b}, {4, 5, b}, {0, 1, a}};
  const Snaps snaps(points, others);
  const Sides path = {{0, 3, a}, {3, 4, a}, {4, 2, a}, {2, 1, a}};
  Sides found = snaps.applied(Sides{{0, 1, a}});
  std::ranges::sort(found);
  Sides expected = path;
  std::ranges::sort(expected);
  EXPECT_EQ(found, expected);
  Sides back = snaps.applied(Sides{{1, 0, a}});
  std::ranges::sort(back);
  for (OwnedSide& side : expected) std::swap(side.from, side.to);
  std::ranges::sort(expected);
  EXPECT_EQ(back, expected);
}

// A triangle no higher than rounding: its sides cancel.
TEST(snaps, leave_nothing_of_a_sliver) {
  const std::vector<Point> points = {beside_equator(0), beside_equator(1),
                                     beside_equator(0.5, near)};
  const Sides sides = {{0, 1, a}, {1, 2, a}, {2, 0, a}};
  const Snaps snaps(points, sides);
  EXPECT_TRUE(snaps.applied(sides).empty());
  // Sides of different owners do not cancel.
  EXPECT_EQ(snaps.applied(Sides{{0, 1, a}, {1, 2, b}, {2, 0, b}}).size(), 4U);
}

// Points 0 and 3 are one but for rounding, and have the lower number.
TEST(snaps, merge_corners_in_one_place) {
  const std::vector<Point> points = {
      beside_equator(0), beside_equator(1), {0, 0, 1}, beside_equator(0, near)};
  const Sides sides = {{0, 1, a}, {1, 2, a}, {2, 3, a}, {3, 0, a}};
  const Snaps snaps(points, sides);
  EXPECT_TRUE(snaps.would_change(sides));
  EXPECT_EQ(snaps.applied(sides), (Sides{{0, 1, a}, {2, 0, a}, {1, 2, a}}));
  // Corners that are no ends of one side are merged as well, and one that is near an end of a side divides it nowhere.
  const Sides apart = {{0, 1, a}, {2, 3, b}};
  EXPECT_EQ(Snaps(points, apart).applied(apart), (Sides{{0, 1, a}, {2, 0, b}}));
}

}  // namespace
}  // namespace rondel::test::of_snaps
