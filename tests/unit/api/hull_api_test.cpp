// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The promises of rondel/hull.h beyond the shape of the hull.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "rondel/error.h"
#include "rondel/hull.h"
#include "support/hull_check.h"

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
  try {
    convex_hull(points);
  } catch (const InvalidInput& error) {
    return error.index();
  }
  return points.size();
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

}  // namespace
}  // namespace rondel::test
