// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Compares small hulls with brute force around the same center, and with their definition.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "rondel/hull.h"
#include "support/generators.h"
#include "support/hull_check.h"
#include "support/hull_oracle.h"

namespace rondel::test {
namespace {

std::string text(std::span<const Point> points) {
  std::string out;
  char buffer[128];
  for (const Point& p : points) {
    std::snprintf(buffer, sizeof buffer, "{%a, %a, %a},\n", p.x, p.y, p.z);
    out += buffer;
  }
  return out;
}

void expect_hull(const std::vector<Point>& points) {
  const Triangulation hull = convex_hull(points);
  EXPECT_EQ(hull_error(hull, points), "") << text(points);
  const Hull expected = brute_force_hull(points, Model::weighted, hull.sphere());
  EXPECT_EQ(difference(hull, points, expected), "") << text(points);
}

class small_hulls : public testing::TestWithParam<Generator> {};

TEST_P(small_hulls, are_those_of_brute_force) {
  for (std::uint64_t seed = 0; seed < scaled(12) && !HasFailure(); ++seed) {
    SiteSet set = GetParam().make(1 + seed % 12, seed);
    if (set.sites.size() > 13) set.sites.resize(13);
    expect_hull(set.sites);
  }
}

INSTANTIATE_TEST_SUITE_P(kinds, small_hulls,
                         testing::ValuesIn(generators().begin(), generators().end()),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST(small_hull, of_every_few_corners_of_a_cube_with_its_middle) {
  for (unsigned subset = 0; subset < 512 && !HasFailure(); ++subset) {
    std::vector<Point> points;
    for (unsigned i = 0; i < 8; ++i) {
      if ((subset >> i & 1) != 0)
        points.push_back({i & 1 ? 2. : 0., i & 2 ? 2. : 0., i & 4 ? 2. : 0.});
    }
    if (subset >= 256) points.push_back({1, 1, 1});
    expect_hull(points);
  }
}

// A plane of integers with sites moved off it by one ulp: no double need lie inside.
TEST(small_hull, may_be_one_ulp_thick) {
  Random random(7);
  std::size_t without_inner_double = 0;
  for (int i = 0; i < 200 && !HasFailure(); ++i) {
    const double height = random.coin() ? 1.0 : random.between(-3, 3);
    std::vector<Point> points;
    for (int k = 0; k < 9; ++k) {
      const double x = random.between(0, 4);
      const double y = random.between(0, 4);
      const bool is_tilted = random.coin();
      points.push_back({x, y, is_tilted ? height + x : height});
      if (random.below(3) != 0) continue;
      Point& p = points.back();
      p.z = std::nextafter(p.z, std::numeric_limits<double>::infinity());
    }
    expect_hull(points);
    const Triangulation hull = convex_hull(points);
    if (hull.dimension() == 2 && hull.num_ghost_faces() > 0) ++without_inner_double;
  }
  EXPECT_GT(without_inner_double, 0U);
}

TEST(small_hull, may_be_one_subnormal_thick) {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const std::vector<Point> points = {{0, 0, 0},  {1, 0, 0},        {0, 1, 0},       {1, 1, 0},
                                     {.5, 0, 0}, {.25, .5, least}, {.5, .5, least}, {.5, .5, 0}};
  expect_hull(points);
  const Triangulation hull = convex_hull(points);
  EXPECT_EQ(hull.dimension(), 2);
  EXPECT_EQ(hull.num_vertices(), 6U);
  EXPECT_EQ(hull.sphere().center, (Point{0, 0, 0}));
}

TEST(small_hull, may_span_the_range_of_doubles) {
  constexpr double most = std::numeric_limits<double>::max();
  expect_hull(
      {{most, 0, 0}, {-most, 0, 0}, {0, most, 0}, {0, -most, 0}, {0, 0, most}, {0, 0, -most}});
  expect_hull({{most, most, most},
               {-most, most, most},
               {most, -most, most},
               {most, most, -most},
               {-most, -most, -most},
               {0, 0, 0},
               {1e-300, 1e-300, 1e-300},
               {1, 2, 3}});
  expect_hull({{1e300, 0, 0}, {0, 1e-300, 0}, {0, 0, 1}, {1e-300, 1e-300, 1e-300}, {0, 0, 0}});
  Random random(8);
  for (std::size_t i = 0; i < scaled(40) && !HasFailure(); ++i) {
    std::vector<Point> points;
    for (int k = 0; k < 9; ++k) {
      const auto number = [&] {
        return std::ldexp(random.signed_unit(), 500 * random.between(-2, 2));
      };
      const double x = number();
      const double y = number();
      points.push_back({x, y, number()});
    }
    expect_hull(points);
  }
}

}  // namespace
}  // namespace rondel::test
