// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Power cells of circles: the cell of a site is where its power distance is least, that is where
// p.u is largest over all sites p.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "support/generators.h"
#include "support/oracle.h"

namespace rondel::test {
namespace {

const Options weighted{.model = Model::weighted};

double product(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Whether a.u > b.u, exactly.
bool is_nearer(const Point& a, const Point& b, const Point& u) {
  const Oracle oracle(std::array{a, b, u}, Model::weighted, {});
  return dot(oracle.vector(0), oracle.vector(2)) > dot(oracle.vector(1), oracle.vector(2));
}

// By brute force over all sites, hidden ones too.
std::size_t nearest(std::span<const Point> sites, const Point& u) {
  std::size_t best = 0;
  double largest = product(sites[0], u);
  for (std::size_t i = 1; i < sites.size(); ++i) {
    const double value = product(sites[i], u);
    const double doubt =
        1e-15 * std::sqrt(product(sites[i], sites[i]) + product(sites[best], sites[best]));
    if (value < largest - doubt) continue;
    if (value > largest + doubt || is_nearer(sites[i], sites[best], u)) {
      best = i;
      largest = value;
    }
  }
  return best;
}

// The least det(a, b, u) over the edges (a, b) of the cell, relative to the edge's length: the sine
// of the distance by which u is inside.
double depth(const Cells& cells, std::size_t site, const Point& u) {
  const auto first = cells.offsets[site];
  const auto count = cells.offsets[site + 1] - first;
  double least = count == 0 ? -1 : 1;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Point& a = cells.points[cells.rings[first + i]];
    const Point& b = cells.points[cells.rings[first + (i + 1) % count]];
    const Point normal = cross_product(a, b - a);
    const double length = std::sqrt(product(normal, normal));
    // An edge shorter than the rounding of its ends tells nothing.
    if (length > 1e-9) least = std::min(least, product(normal, u) / length);
  }
  return least;
}

void expect_power_cells(std::span<const Point> sites, std::size_t num_directions) {
  const Triangulation triangulation = delaunay(sites, weighted);
  const auto [cells, areas] = diagram(triangulation);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0) / (4 * std::numbers::pi), 1, 1e-12);
  for (const Hidden& hidden : triangulation.hidden()) {
    ASSERT_EQ(cells.offsets[hidden.site], cells.offsets[hidden.site + 1]);
    ASSERT_EQ(areas[hidden.site], 0);
  }
  Random random(11);
  for (std::size_t i = 0; i < num_directions; ++i) {
    const Point u = random_direction(random);
    const std::size_t site = nearest(sites, u);
    ASSERT_GT(areas[site], 0) << site;
    ASSERT_GT(depth(cells, site, u), -1e-6) << site;
  }
}

std::vector<Point> random_circles(std::size_t n, double most_deg) {
  Random random(12);
  std::vector<Point> sites(n);
  for (Point& p : sites) p = polar_point(random_direction(random), most_deg * random.unit());
  return sites;
}

TEST(power_cells, hold_the_directions_of_least_power_distance) {
  expect_power_cells(random_circles(100'000, 30), 300);
}

TEST(power_cells, of_small_circles) { expect_power_cells(random_circles(20'000, 0.5), 1000); }

TEST(power_cells, of_named_sets) {
  for (const auto name : {"circles", "mixed_magnitudes", "imaginary_circles"}) {
    SCOPED_TRACE(name);
    expect_power_cells(generator(name).make(5'000, 13).sites, 1000);
  }
}

// The circles are all on one side; their cells cover the sphere nevertheless.
TEST(power_cells, where_the_center_is_outside_the_hull) {
  auto sites = random_circles(5'000, 20);
  for (Point& p : sites) p.z = std::abs(p.z) + 0.25;
  expect_power_cells(sites, 2000);
}

// The pole with radius r against five sites of radius 0 in the other directions of the axes: its
// cell is a square with four equal angles pi - acos(h^2 / (1 + h^2)), h = 1 / cos r.
TEST(power_cells, have_the_areas_of_a_closed_form) {
  for (const double radius_deg : {0.0, 1e-3, 20.0, 45.0, 75.0, 89.0}) {
    const std::vector<Point> sites = {polar_point(Point{0, 0, 1}, radius_deg),
                                      {1, 0, 0},
                                      {0, 1, 0},
                                      {-1, 0, 0},
                                      {0, -1, 0},
                                      {0, 0, -1}};
    const double h = sites[0].z;
    const double area = 2 * std::numbers::pi - 4 * std::acos(h * h / (1 + h * h));
    EXPECT_NEAR(diagram(delaunay(sites, weighted)).areas[0], area, 1e-12);
  }
}

}  // namespace
}  // namespace rondel::test
