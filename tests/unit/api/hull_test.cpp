// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The promises of rondel/hull.h beyond the shape of the hull.
#include "rondel/hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "rondel/error.h"
#include "support/generators.h"
#include "support/hull_check.h"
#include "support/hull_oracle.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

std::vector<Point> cube_corners() {
  std::vector<Point> points;
  for (const double x : {0, 2}) {
    for (const double y : {0, 2}) points.insert(points.end(), {{x, y, 0}, {x, y, 2}});
  }
  return points;
}

std::size_t bad_index(const std::vector<Point>& points) {
  return thrown_index([&] { convex_hull(points); }, points.size());
}

TEST(hull_api, refuses_what_is_not_finite) {
  auto points = cube_corners();
  points[5].y = std::numeric_limits<double>::quiet_NaN();
  points[6].x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(bad_index(points), 5U);
  points[3].z = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(bad_index(points), 3U);
}

TEST(hull_api, takes_an_array_of_numbers) {
  const std::vector<double> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_EQ(convex_hull(xyz).num_faces(), 4U);
  EXPECT_THROW(convex_hull(std::span(xyz).first(11)), InvalidInput);
}

TEST(hull_api, has_a_dimension_for_every_input) {
  const std::vector<Point> nothing;
  EXPECT_EQ(convex_hull(nothing).dimension(), -1);
  const std::vector<Point> place = {{3, 4, 5}, {3, 4, 5}, {3, 4, 5}};
  EXPECT_EQ(convex_hull(place).dimension(), 0);
  EXPECT_EQ(convex_hull(place).ring().size(), 1U);
  EXPECT_EQ(convex_hull(place).duplicates().size(), 2U);
  const std::vector<Point> line = {{2, 2, 2}, {1, 1, 1}, {3, 3, 3}, {1, 1, 1}};
  const Triangulation ends = convex_hull(line);
  EXPECT_EQ(ends.dimension(), 1);
  EXPECT_EQ(std::vector(ends.ring().begin(), ends.ring().end()), (std::vector<Index>{1, 2}));
  ASSERT_EQ(ends.hidden().size(), 1U);
  EXPECT_EQ(ends.hidden()[0], (Hidden{0, no_index}));
}

TEST(hull_api, lists_the_corners_of_a_flat_hull_counterclockwise) {
  const std::vector<Point> points = {{5, 1, 1}, {5, 0, 0}, {5, 2, 0}, {5, 2, 2},
                                     {5, 1, 0}, {5, 0, 2}, {5, 2, 1}};
  const Triangulation hull = convex_hull(points);
  EXPECT_EQ(hull.dimension(), 1);
  EXPECT_EQ(std::vector(hull.ring().begin(), hull.ring().end()), (std::vector<Index>{1, 2, 3, 5}));
  EXPECT_EQ(hull.hidden().size(), 3U);
}

TEST(hull_api, measures_volume_and_area) {
  const auto points = cube_corners();
  const HullSize cube = size_of_hull(convex_hull(points));
  EXPECT_DOUBLE_EQ(cube.volume, 8);
  EXPECT_DOUBLE_EQ(cube.area, 24);
  const std::vector<Point> square = {{1, 1, 7}, {3, 1, 7}, {3, 3, 7}, {1, 3, 7}, {2, 2, 7}};
  const HullSize flat = size_of_hull(convex_hull(square));
  EXPECT_EQ(flat.volume, 0);
  EXPECT_DOUBLE_EQ(flat.area, 8);
  const auto ball = solid_clouds()[0].make(100000, 1);
  const HullSize size = size_of_hull(convex_hull(ball));
  EXPECT_LT(size.volume, 4 * std::numbers::pi / 3);
  EXPECT_GT(size.volume, 0.98 * 4 * std::numbers::pi / 3);
  EXPECT_LT(size.area, 4 * std::numbers::pi);
  EXPECT_GT(size.area, 0.98 * 4 * std::numbers::pi);
}

TEST(hull_api, measures_at_both_ends_of_the_range) {
  const auto scaled_size = [](double scale) {
    auto points = cube_corners();
    for (Point& p : points) p = {scale * (p.x - 1), scale * (p.y - 1), scale * (p.z - 1)};
    return size_of_hull(convex_hull(points));
  };
  const double largest = std::numeric_limits<double>::max();
  EXPECT_EQ(scaled_size(largest).volume, std::numeric_limits<double>::infinity());
  EXPECT_EQ(scaled_size(largest).area, std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(scaled_size(0x1p300).volume, 0x1p903);
  EXPECT_DOUBLE_EQ(scaled_size(0x1p-300).volume, 0x1p-897);
  EXPECT_EQ(scaled_size(0x1p-1070).area, 0);
}

TEST(hull_api, does_not_depend_on_the_sign_of_zero) {
  std::vector<Point> points = {{0, 0, 0}, {-0.0, -0.0, -0.0}, {1, 0, 0}, {0, 1, 0}};
  const Point first = convex_hull(points).sphere().center;
  std::swap(points[0], points[1]);
  const Point second = convex_hull(points).sphere().center;
  EXPECT_EQ(std::signbit(first.x), std::signbit(second.x));
  EXPECT_EQ(std::signbit(first.z), std::signbit(second.z));
}

TEST(hull_api, reports_progress) {
  std::size_t calls = 0;
  convex_hull(cube_corners(), {.progress = [&calls](std::string_view, double) { ++calls; }});
  EXPECT_GT(calls, 0U);
}

// Compares small hulls with brute force around the same center, and with their definition.

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

// Large hulls, each proved by exact arithmetic in linear time.

class solid_hulls : public testing::TestWithParam<Cloud> {};
class flat_hulls : public testing::TestWithParam<Cloud> {};

std::string name_of(const testing::TestParamInfo<Cloud>& cloud) {
  return std::string(cloud.param.name);
}

TEST_P(solid_hulls, are_exact) {
  const std::vector<Point> points = GetParam().make(scaled(100000), 1);
  const Triangulation hull = convex_hull(points);
  EXPECT_EQ(hull.dimension(), 2);
  EXPECT_EQ(hull_error(hull, points), "");
  EXPECT_EQ(hull.num_ghost_faces(), 0U);
}

TEST_P(flat_hulls, are_exact) {
  const std::vector<Point> points = GetParam().make(scaled(3000), 1);
  const Triangulation hull = convex_hull(points);
  EXPECT_EQ(hull.dimension(), 1);
  EXPECT_EQ(hull_error(hull, points), "");
}

// Everything but the names of the sites, which change with the order: sites by coordinates.
struct Shape {
  Point center;
  std::vector<Point> corners;
  std::vector<Triple> neighbors;
  std::vector<Point> ring;
  std::set<std::pair<std::array<double, 3>, Index>> hidden;
  std::size_t num_duplicates;
  friend bool operator==(const Shape&, const Shape&) = default;
};

Shape shape_of(const std::vector<Point>& points) {
  const Triangulation hull = convex_hull(points);
  Shape shape;
  shape.center = hull.sphere().center;
  for (const Triple& face : hull.faces()) {
    for (const Index corner : face) shape.corners.push_back(points[corner]);
  }
  shape.neighbors.assign(hull.neighbors().begin(), hull.neighbors().end());
  for (const Index corner : hull.ring()) shape.ring.push_back(points[corner]);
  if (shape.ring.size() == 2 && shape.ring[1].x < shape.ring[0].x) {
    std::swap(shape.ring[0], shape.ring[1]);  // a line's ends come in the order of input
  }
  for (const Hidden& h : hull.hidden()) {
    const Point& p = points[h.site];
    shape.hidden.insert({{p.x, p.y, p.z}, h.face});
  }
  shape.num_duplicates = hull.duplicates().size();
  return shape;
}

void expect_any_order(std::vector<Point> points) {
  const Shape first = shape_of(points);
  Random(3).shuffle(points);
  const bool is_equal = shape_of(points) == first;
  EXPECT_TRUE(is_equal);
}

TEST_P(solid_hulls, do_not_depend_on_the_order) { expect_any_order(GetParam().make(20000, 2)); }
TEST_P(flat_hulls, do_not_depend_on_the_order) { expect_any_order(GetParam().make(2000, 2)); }

INSTANTIATE_TEST_SUITE_P(clouds, solid_hulls,
                         testing::ValuesIn(solid_clouds().begin(), solid_clouds().end()), name_of);
INSTANTIATE_TEST_SUITE_P(clouds, flat_hulls,
                         testing::ValuesIn(flat_clouds().begin(), flat_clouds().end()), name_of);

}  // namespace
}  // namespace rondel::test
