// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include "support/mpfr_oracle.h"
#include "unit/dual/support.h"

namespace rondel::test {
namespace {

double perimeter(const Cells& cells, std::size_t site) {
  const auto ring = ring_of(cells, site);
  double sum = 0;
  for (std::size_t j = 0; j < ring.size(); ++j) {
    const Point step = cells.points[ring[j]] - cells.points[ring[(j + 1) % ring.size()]];
    sum += std::sqrt(dot_product(step, step));
  }
  return sum;
}

TEST(centroids, agree_with_long_numbers_for_every_generator) {
  for_each_case(12, 2, [](const DualCase& c) {
    const Cells diagram = cells(c.triangulation);
    const auto result = centroids(c.triangulation);
    const auto area = areas(c.triangulation);
    const DualOracle oracle(c.triangulation, c.sites);
    for (Index i = 0; i < c.sites.size(); ++i) {
      if (ring_of(diagram, i).empty()) {
        EXPECT_EQ(result[i], Point{}) << c.name;
        continue;
      }
      EXPECT_NEAR(dot_product(result[i], result[i]), 1, 1e-15) << c.name;
      // A thin cell's center is uncertain along it; rounding errors of the circumcenters exceed
      // the width of the thinnest.
      const double length = perimeter(diagram, i);
      if (area[i] <= 1e-12 * length) continue;
      const auto exact = polygon_centroid(oracle.ring(diagram, i));
      ASSERT_TRUE(exact.has_value()) << c.name;
      EXPECT_LE(distance_in_ulps(result[i], *exact), 16 * length * length / area[i])
          << c.name << " site " << i;
    }
  });
}

TEST(centroids, of_the_octahedron_are_its_corners) {
  const auto sites = octahedron();
  const auto result = centroids(triangulated(sites));
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_LE(distance_in_ulps(result[i], to_real(sites[i])), 4);
  }
}

TEST(centroids, of_tiny_cells_are_within_a_few_ulp) {
  const DualCase c = make_case(generator("patch_1e_9"), 60, 1, Model::projected);
  const Cells diagram = cells(c.triangulation);
  const auto result = centroids(c.triangulation);
  const auto area = areas(c.triangulation);
  const DualOracle oracle(c.triangulation, c.sites);
  int num_tiny = 0;
  for (Index i = 0; i < c.sites.size(); ++i) {
    if (area[i] > 1e-15) continue;
    ++num_tiny;
    const auto exact = polygon_centroid(oracle.ring(diagram, i));
    EXPECT_LE(distance_in_ulps(result[i], exact.value()), 8);
  }
  EXPECT_GT(num_tiny, 20);
}

TEST(centroids, of_hemispheres_and_lunes) {
  const std::vector<Point> two = {{0, 0, 1}, {0, 0, -1}};
  EXPECT_EQ(centroids(triangulated(two)), two);
  const std::vector<Point> four = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const auto result = centroids(triangulated(four));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LE(distance_in_ulps(result[i], to_real(four[i])), 4);
}

TEST(centroids, of_the_whole_sphere_is_its_center) {
  const std::vector<Point> sites = {{1, 2, 3}};
  EXPECT_EQ(centroids(triangulated(sites)), std::vector<Point>{Point{}});
}

}  // namespace
}  // namespace rondel::test
