// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regular triangulations of circles against exact rational arithmetic: the surface is closed, every
// edge is locally convex, the surface surrounds the center once, and every hidden site lies in the
// cone and below the plane of its face. So it is the convex hull of the points q / cos r.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rondel/check.h"
#include "rondel/delaunay.h"
#include "support/generators.h"
#include "support/surface_check.h"

namespace rondel::test {
namespace {

const Options weighted{.model = Model::weighted};

std::vector<Point> random_circles(std::size_t n, double least_deg, double most_deg,
                                  std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> centers(n);
  std::vector<double> radii_deg(n);
  for (std::size_t i = 0; i < n; ++i) {
    centers[i] = random_direction(random);
    radii_deg[i] = least_deg + (most_deg - least_deg) * random.unit();
  }
  return polar_points(centers, radii_deg);
}

std::size_t many() { return is_shortened() ? 20'000 : 100'000; }

void expect_hull(const Triangulation& triangulation, std::span<const Point> sites) {
  ASSERT_EQ(topology_error(triangulation), "");
  ASSERT_EQ(order_error(triangulation), "");
  ASSERT_EQ(geometry_error(triangulation, sites), "");
  const CheckReport report = check(sites, triangulation.faces(), weighted);
  EXPECT_TRUE(report.is_valid) << report.reason;
  EXPECT_EQ(report.num_hidden, triangulation.hidden().size());
}

TEST(hull_of_circles, many_circles_of_up_to_30_degrees_hide_most) {
  const auto sites = random_circles(many(), 0, 30, 1);
  const Triangulation triangulation = delaunay(sites, weighted);
  EXPECT_EQ(triangulation.num_ghost_faces(), 0U);
  EXPECT_GT(triangulation.hidden().size(), sites.size() / 10 * 9);
  EXPECT_GT(triangulation.num_vertices(), sites.size() / 100);
  expect_hull(triangulation, sites);
}

TEST(hull_of_circles, small_circles_hide_few) {
  const double most_deg = 95 / std::sqrt(static_cast<double>(many()));  // half of their distance
  const auto sites = random_circles(many(), 0, most_deg, 2);
  const Triangulation triangulation = delaunay(sites, weighted);
  EXPECT_GT(triangulation.hidden().size(), sites.size() / 100);
  EXPECT_GT(triangulation.num_vertices(), sites.size() / 10 * 9);
  expect_hull(triangulation, sites);
}

// Few circles of nearly 90 degrees, which are points far away, among many of radius 0.
TEST(hull_of_circles, mixed_magnitudes_are_decided_by_the_filter) {
  for (const double radius_deg : {60.0, 89.0, 89.9999, 90 - 0x1p-30, 90 - 0x1p-44}) {
    Random random(3);
    auto sites = random_circles(20'000, 0, 0, 4);
    // On one side, so that the others are not all inside their hull.
    for (std::size_t i = 0; i < 5; ++i) {
      const LonLat center{360 * random.unit(), 10 + 40 * random.unit()};
      sites[random.below(sites.size())] = polar_point(center, radius_deg);
    }
    const Triangulation triangulation = delaunay(sites, weighted);
    EXPECT_GT(triangulation.hidden().size(), 1'000U) << radius_deg;
    EXPECT_GT(triangulation.num_vertices(), 100U) << radius_deg;
    const Tally& rungs = triangulation.report().rungs;
    EXPECT_LT(rungs.extended + rungs.double_double + rungs.exact + rungs.perturbed,
              rungs.filter / 1000);
    expect_hull(triangulation, sites);
  }
}

TEST(hull_of_circles, all_radii_up_to_90_degrees) {
  auto sites = random_circles(20'000, 0, std::nextafter(90.0, 0.0), 5);
  expect_hull(delaunay(sites, weighted), sites);
}

// In a hemisphere the center is outside the hull.
TEST(hull_of_circles, in_a_hemisphere) {
  auto sites = random_circles(20'000, 0, 20, 6);
  for (Point& p : sites) p.z = std::abs(p.z) + 0.25;
  const Triangulation triangulation = delaunay(sites, weighted);
  EXPECT_GT(triangulation.num_ghost_faces(), 0U);
  expect_hull(triangulation, sites);
}

// Points inside the sphere, whose circles are imaginary, are hidden only if others reach farther.
TEST(hull_of_circles, imaginary_ones_count_like_real_ones) {
  Random random(7);
  auto sites = random_circles(20'000, 0, 0, 8);
  for (Point& p : sites) p = (1 - 1e-4 * random.unit()) * p;
  const Triangulation triangulation = delaunay(sites, weighted);
  EXPECT_GT(triangulation.hidden().size(), 100U);
  EXPECT_GT(triangulation.num_vertices(), 15'000U);
  expect_hull(triangulation, sites);
  for (Point& p : sites) p = 0.25 * p;  // deep inside: the same hull
  EXPECT_TRUE(std::ranges::equal(delaunay(sites, weighted).faces(), triangulation.faces()));
}

TEST(hull_of_circles, a_circle_within_a_larger_one_is_hidden_below_its_faces) {
  const std::vector<LonLat> centers = {{0, 0},  {90, 0},  {180, 0}, {-90, 0},
                                       {0, 90}, {0, -90}, {0, 0},   {10, 10}};
  const std::vector<double> radii_deg = {60, 20, 20, 20, 20, 20, 59, 1};
  const auto sites = polar_points(centers, radii_deg);
  const Triangulation triangulation = delaunay(sites, weighted);
  ASSERT_EQ(triangulation.hidden().size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& [site, face] = triangulation.hidden()[i];
    EXPECT_EQ(site, 6 + i);
    EXPECT_TRUE(std::ranges::count(triangulation.faces()[face], Index{0}) == 1);
  }
}

}  // namespace
}  // namespace rondel::test
