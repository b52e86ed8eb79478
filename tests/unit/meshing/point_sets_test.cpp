// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/point_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "rondel/query.h"

namespace rondel::mesh {
namespace {

void expect_unit(const std::vector<Point>& points) {
  for (const Point& p : points) {
    ASSERT_NEAR(p.x * p.x + p.y * p.y + p.z * p.z, 1, 1e-15);
  }
  EXPECT_TRUE(delaunay(points).duplicates().empty());
}

TEST(point_sets, icosahedral_points_have_five_or_six_neighbors) {
  const std::vector<Point> points = icosahedral_points(4);
  ASSERT_EQ(points.size(), 2562U);
  expect_unit(points);
  const Triangulation triangulation = delaunay(points);
  std::vector<int> degrees(points.size());
  for (const Triple& face : triangulation.faces()) {
    for (const Index v : face) ++degrees[v];
  }
  EXPECT_EQ(std::ranges::count(degrees, 5), 12);
  EXPECT_EQ(std::ranges::count(degrees, 6), 2550);
}

// Pixels have equal areas, so sums of harmonics of low degree vanish; and the first center is known.
TEST(point_sets, healpix_centers_are_those_of_equal_areas) {
  for (const std::size_t side : std::vector<std::size_t>{1, 2, 3, 8}) {
    const std::vector<Point> points = healpix_points(side);
    ASSERT_EQ(points.size(), 12 * side * side);
    expect_unit(points);
    Point sum{};
    double squares = 0;
    for (const Point& p : points) {
      sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
      squares += p.z * p.z;
    }
    EXPECT_NEAR(std::abs(sum.x) + std::abs(sum.y) + std::abs(sum.z), 0, 1e-11);
    EXPECT_NEAR(squares / static_cast<double>(points.size()), 1.0 / 3,
                0.3 / static_cast<double>(side * side));
  }
  const Point first = healpix_points(4).front();
  EXPECT_NEAR(first.z, 1 - 1.0 / 48, 1e-15);
  EXPECT_NEAR(first.x, first.y, 1e-15);
}

TEST(point_sets, rows_of_the_reduced_gaussian_grid_are_roots) {
  // Abramowitz and Stegun, table 25.4, n = 8.
  const std::vector<Point> points = reduced_gaussian_points(4);
  ASSERT_EQ(points.size(), 4U * 4 * 13);
  expect_unit(points);
  EXPECT_NEAR(points[0].z, 0.960289856497536, 1e-15);
  EXPECT_NEAR(points[20].z, 0.796666477413627, 1e-15);
  EXPECT_NEAR(points[44].z, 0.525532409916329, 1e-15);
  EXPECT_NEAR(points[72].z, 0.183434642495650, 1e-15);
  EXPECT_EQ(points.back().z, -points[0].z);
  EXPECT_EQ(points[0].y, 0);
  EXPECT_NEAR(reduced_gaussian_points(320)[0].z, std::sin(89.784876907219 * std::numbers::pi / 180),
              1e-13);
}

TEST(point_sets, cubed_sphere_is_symmetric) {
  const std::vector<Point> points = cubed_sphere_points(6);
  ASSERT_EQ(points.size(), 216U);
  expect_unit(points);
  Point sum{};
  for (const Point& p : points) sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
  EXPECT_NEAR(std::abs(sum.x) + std::abs(sum.y) + std::abs(sum.z), 0, 1e-13);
  EXPECT_NEAR(points[0].y / points[0].x, -std::tan(37.5 * std::numbers::pi / 180), 1e-15);
}

TEST(point_sets, disks_keep_their_distance_and_leave_no_gap) {
  for (const double radius : {1.0, 0.3, 0.05, 0.02}) {
    const std::vector<Point> points = poisson_disk_points(radius, 3);
    expect_unit(points);
    const Triangulation triangulation = delaunay(points);
    const Locator locator(triangulation);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const Index j : locator.neighbors(static_cast<Index>(i))) {
        EXPECT_GE(locator.distance(points[i], j), radius);
      }
    }
    const std::vector<Point> centers = circumcenters(triangulation);
    for (std::size_t f = 0; f < centers.size(); ++f) {
      EXPECT_LE(locator.distance(centers[f], triangulation.faces()[f][0]), radius * (1 + 1e-12));
    }
  }
}

TEST(point_sets, seeds_and_threads) {
  EXPECT_EQ(poisson_disk_points(0.1, 5, {.threads = 1}),
            poisson_disk_points(0.1, 5, {.threads = 3}));
  EXPECT_NE(poisson_disk_points(0.1, 5), poisson_disk_points(0.1, 6));
}

TEST(point_sets, sizes_out_of_range_are_refused) {
  EXPECT_THROW((void)icosahedral_points(13), InvalidInput);
  EXPECT_THROW((void)healpix_points(0), InvalidInput);
  EXPECT_THROW((void)reduced_gaussian_points(0), InvalidInput);
  EXPECT_THROW((void)cubed_sphere_points(0), InvalidInput);
  EXPECT_THROW((void)poisson_disk_points(0), InvalidInput);
  EXPECT_THROW((void)poisson_disk_points(std::nan("")), InvalidInput);
}

}  // namespace
}  // namespace rondel::mesh
