// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks which circles a figure of weighted sites shows.
#include <gtest/gtest.h>

#include "globe.h"
#include "plot_circles.h"
#include "rondel/delaunay.h"

namespace rondel::cli {
namespace {

std::vector<Circle> circles_of(const std::vector<Point>& sites, const Sphere& sphere = {},
                               std::vector<double> radii_deg = {}) {
  SiteTable table;
  table.sites = sites;
  table.radii_deg = std::move(radii_deg);
  std::vector<Point> directions;
  for (const Point& p : sites) {
    const Point v{p.x - sphere.center.x, p.y - sphere.center.y, p.z - sphere.center.z};
    directions.push_back(v == Point{} ? v : normalized(v));
  }
  const Triangulation triangulation = delaunay(sites, {.model = Model::weighted, .sphere = sphere});
  return real_circles(table, triangulation, directions);
}

TEST(real_circles, have_the_radii_from_which_sites_were_made) {
  for (const double radius_deg : {1e-5, 0.5, 30.0, 60.0, 89.9999, 90 - 1e-9}) {
    const auto circles = circles_of({polar_point(LonLat{20, 30}, radius_deg)});
    ASSERT_EQ(circles.size(), 1U);
    // The error of a length, 1e-16, is much against the square of a small radius.
    EXPECT_NEAR(circles[0].radius_deg / radius_deg, 1, radius_deg < 1e-3 ? 0.02 : 1e-9);
    EXPECT_NEAR(angle_between(circles[0].axis, unit_vector({20, 30})), 0, 1e-15);
  }
}

TEST(real_circles, take_the_radii_of_the_table) {
  const auto circles = circles_of({polar_point(Point{0, 0, 1}, 1e-9)}, {}, {1e-9});
  ASSERT_EQ(circles.size(), 1U);
  EXPECT_EQ(circles[0].radius_deg, 1e-9);
}

TEST(real_circles, leave_out_points_imaginary_ones_and_the_center) {
  EXPECT_TRUE(circles_of({{0, 0, 1}, {0.5, 0, 0}, {0, 0, 0}, {0, -0.99, 0}}).empty());
  const Sphere sphere{{10, 0, 0}, 4};
  const auto circles = circles_of({{12, 0, 0}, {14, 0, 0}, {10, 0, 0}, {10, 1, 0}}, sphere);
  ASSERT_EQ(circles.size(), 1U);
  EXPECT_NEAR(circles[0].radius_deg, 60, 1e-12);
}

TEST(real_circles, show_duplicates_once_and_mark_hidden_ones) {
  const std::vector<Point> sites = {{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0},
                                    {0, 0, 2}, {0, 0, -2}, {2, 0, 0}, {1.5, 0, 0}};
  const auto circles = circles_of(sites);
  ASSERT_EQ(circles.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(circles[i].is_hidden, i == 6);
}

}  // namespace
}  // namespace rondel::cli
