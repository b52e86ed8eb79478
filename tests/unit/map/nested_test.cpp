// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Owners of loops that are nearly as large as each other, and loops that share corners.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "map/planar_loops.h"
#include "support/random.h"

namespace rondel::test::of_nested {
namespace {

using map::Loop;

Loop loop_from(const Loop& loop, std::size_t first) {
  Loop turned = loop;
  std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
  return turned;
}

Loop reversed_loop(Loop loop) {
  std::ranges::reverse(loop);
  return loop;
}

// A shape in itself three times, each a little smaller, turned and sheared by whole numbers. The innermost hole belongs to the
// smaller one of the two rings around it.
TEST(owners_of, rings_that_are_nearly_of_one_size) {
  Random random(72);
  const std::vector<Loop> shapes = {{{8, -8}, {8, 8}, {-8, 8}, {-8, -8}},
                                    {{0, -8}, {8, 8}, {-8, 8}},
                                    {{-9, -3}, {10, -4}, {11, 2}, {1, 9}, {-8, 8}}};
  const auto small = [&] { return static_cast<double>(random.below(5)) - 2; };
  for (int round = 0; round < 400; ++round) {
    const Loop& shape = shapes[random.below(shapes.size())];
    const double a = small();
    const double b = small();
    const double c = small();
    const double d = small();
    if (a * d - b * c <= 0) continue;
    const LonLat center{4 * small() * static_cast<double>(random.below(8)), 4 * small()};
    std::vector<Loop> rings;
    for (const double size : {1.0, 0.9375, 0.875, 0.8125}) {
      Loop& ring = rings.emplace_back();
      for (const LonLat& p : loop_from(shape, random.below(shape.size()))) {
        ring.push_back({center.lon_deg + size * (a * p.lon_deg + b * p.lat_deg),
                        center.lat_deg + size * (c * p.lon_deg + d * p.lat_deg)});
      }
    }
    const std::vector<Loop> loops = {rings[0], rings[2], reversed_loop(rings[1]),
                                     reversed_loop(rings[3])};
    EXPECT_EQ(map::owners_of(loops, 2), (std::vector<std::size_t>{0, 1, 0, 1})) << round;
    const std::vector<Loop> swapped = {rings[2], rings[0], reversed_loop(rings[3]),
                                       reversed_loop(rings[1])};
    EXPECT_EQ(map::owners_of(swapped, 2), (std::vector<std::size_t>{0, 1, 0, 1})) << round;
  }
}

TEST(owners_of, misplaced_loops) {
  const Loop large = {{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  const Loop middle = {{1, 1}, {8, 1}, {8, 8}, {1, 8}};
  const Loop small = {{2, 2}, {7, 2}, {7, 7}, {2, 7}};
  const Loop away = {{20, 2}, {27, 2}, {27, 7}, {20, 7}};
  constexpr std::size_t bad = map::misplaced;
  using Owners = std::vector<std::size_t>;
  const auto owners = [](const std::vector<Loop>& loops, std::size_t num_outer) {
    return map::owners_of(loops, num_outer);
  };
  EXPECT_EQ(owners({large}, 1), Owners{0});
  EXPECT_EQ(owners({reversed_loop(large)}, 0), Owners{bad});
  EXPECT_EQ(owners({large, away}, 2), (Owners{0, 1}));
  EXPECT_EQ(owners({large, reversed_loop(away)}, 1), (Owners{0, bad}));
  EXPECT_EQ(owners({large, middle}, 2), (Owners{0, bad}));
  EXPECT_EQ(owners({large, middle, reversed_loop(small)}, 2), (Owners{0, bad, bad}));
  EXPECT_EQ(owners({large, reversed_loop(middle), reversed_loop(small)}, 1), (Owners{0, 0, bad}));
  EXPECT_EQ(owners({large, small, reversed_loop(middle)}, 2), (Owners{0, 1, 0}));
}

// Triangles inside and outside of a square that share some of its corners, from each corner of both.
TEST(owners_of, holes_that_share_corners_with_the_ring) {
  const Loop ring = {{0, 0}, {4, 0}, {8, 0}, {8, 4}, {8, 8}, {4, 8}, {0, 8}, {0, 4}};
  const std::vector<Loop> inside = {{{0, 0}, {8, 4}, {4, 8}},
                                    {{4, 0}, {8, 4}, {0, 8}},
                                    {{8, 0}, {3, 3}, {0, 4}},
                                    {{4, 4}, {8, 0}, {4, 8}}};
  const std::vector<Loop> outside = {{{4, 0}, {6, -3}, {2, -3}},
                                     {{8, 8}, {10, 8}, {9, 12}},
                                     {{0, 4}, {-3, 6}, {-3, 1}},
                                     {{8, 0}, {10, -1}, {9, 3}}};
  for (const bool is_inside : {true, false}) {
    for (const Loop& hole : is_inside ? inside : outside) {
      const bool is_clockwise = map::doubled_loop_area(hole) < 0;
      for (std::size_t k = 0; k < hole.size(); ++k) {
        for (std::size_t first = 0; first < ring.size(); ++first) {
          const Loop own = loop_from(is_clockwise ? hole : reversed_loop(hole), k);
          const std::vector<Loop> loops = {loop_from(ring, first), own};
          const std::vector<std::size_t> expected = {0, is_inside ? 0 : map::misplaced};
          EXPECT_EQ(map::owners_of(loops, 1), expected) << k << ' ' << first;
        }
      }
    }
  }
}

TEST(doubled_loop_area, of_triangles) {
  EXPECT_EQ(map::doubled_loop_area(Loop{{1, 2}, {5, 2}, {1, 9}}), 28);
  EXPECT_EQ(map::doubled_loop_area(Loop{{5, 2}, {1, 2}, {1, 9}}), -28);
  EXPECT_EQ(map::doubled_loop_area(Loop{{-3, -5}, {4, -2}, {-1, 6}}), 7 * 11 - 2 * 3);
}

TEST(owners_of, many_rings_in_any_number_of_threads) {
  std::vector<Loop> loops;
  std::vector<std::size_t> expected;
  const auto add = [&](double west, double south, double size, bool is_hole) {
    Loop loop = {
        {west, south}, {west + size, south}, {west + size, south + size}, {west, south + size}};
    if (is_hole) std::ranges::reverse(loop);
    loops.push_back(std::move(loop));
  };
  for (const bool is_hole : {false, true}) {
    for (std::size_t k = 0; k < 1000; ++k) {
      const double off = is_hole ? 0.25 : 0;
      const std::size_t row = k / 100;
      add(static_cast<double>(k % 100) + off, static_cast<double>(row) + off, is_hole ? 0.25 : 0.75,
          is_hole);
      expected.push_back(k);
    }
  }
  for (const unsigned threads : {1U, 2U, 5U}) {
    EXPECT_EQ(map::owners_of(loops, 1000, threads), expected) << threads;
  }
}

}  // namespace
}  // namespace rondel::test::of_nested
