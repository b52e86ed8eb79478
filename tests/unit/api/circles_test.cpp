// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// polar_point: circles become weighted sites.
#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "rondel/check.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "support/generators.h"
#include "support/oracle.h"
#include "support/surface_check.h"

namespace rondel::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// How far `value` is from numerator / cos(radius), in ulp.
double error_in_ulp(double value, double numerator, double radius_deg) {
  mpfr_t exact;
  mpfr_init2(exact, 300);
  mpfr_const_pi(exact, MPFR_RNDN);
  mpfr_mul_d(exact, exact, radius_deg, MPFR_RNDN);
  mpfr_div_ui(exact, exact, 180, MPFR_RNDN);
  mpfr_cos(exact, exact, MPFR_RNDN);
  mpfr_d_div(exact, numerator, exact, MPFR_RNDN);
  mpfr_sub_d(exact, exact, value, MPFR_RNDN);
  const double error = mpfr_get_d(exact, MPFR_RNDN);
  mpfr_clear(exact);
  return std::abs(error) / (std::nextafter(std::abs(value), infinity) - std::abs(value));
}

TEST(polar_point, of_radius_zero_is_the_center_bit_for_bit) {
  Random random(1);
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  for (int i = 0; i < 1000; ++i) {
    const Point q = i == 0 ? Point{-0.0, 1e-310, -1} : 6371 * random_direction(random);
    const Point p = polar_point(q, 0);
    ASSERT_EQ(bits(p.x), bits(q.x));
    ASSERT_EQ(bits(p.y), bits(q.y));
    ASSERT_EQ(bits(p.z), bits(q.z));
  }
  EXPECT_EQ(polar_point(LonLat{12.5, -30}, 0), unit_vector({12.5, -30}));
}

TEST(polar_point, is_within_two_ulp_up_to_the_last_radius) {
  Random random(2);
  double worst = 0;
  const auto measure = [&](const Point& q, double radius_deg) {
    const Point p = polar_point(q, radius_deg);
    worst = std::max({worst, error_in_ulp(p.x, q.x, radius_deg), error_in_ulp(p.y, q.y, radius_deg),
                      error_in_ulp(p.z, q.z, radius_deg)});
  };
  for (int i = 0; i < 20000; ++i) {
    const double radius_deg = i % 2 == 0 ? 90 * random.unit() : 90 - 90 * std::exp2(-i % 45);
    measure(random_direction(random), radius_deg);
  }
  measure(random_direction(random), std::nextafter(90.0, 0.0));
  measure(random_direction(random), 1e-300);
  RecordProperty("worst_error_in_ulp", std::to_string(worst));
  EXPECT_LE(worst, 2.0);
  EXPECT_GT(polar_point(Point{0, 0, 1}, std::nextafter(90.0, 0.0)).z, 4e15);
}

// 60 degrees is no double in radians: degrees are reduced exactly.
TEST(polar_point, gives_the_same_for_both_kinds_of_center) {
  for (const double radius_deg : {0.0, 1e-9, 30.0, 60.0, 89.9999}) {
    const LonLat center{-74.01, 40.71};
    EXPECT_EQ(polar_point(center, radius_deg), polar_point(unit_vector(center), radius_deg));
    EXPECT_EQ(polar_points(std::vector{center}, std::vector{radius_deg}),
              std::vector{polar_point(center, radius_deg)});
  }
}

TEST(polar_point, refuses_radii_of_no_circle) {
  for (const double bad : {-1e-300, -5.0, 90.0, 95.0, nan, infinity, -infinity}) {
    EXPECT_THROW(polar_point(Point{1, 0, 0}, bad), InvalidInput) << bad;
    EXPECT_THROW(polar_point(LonLat{0, 0}, bad), InvalidInput) << bad;
  }
}

template <class Center>
void expect_invalid(const std::vector<Center>& centers, const std::vector<double>& radii_deg,
                    std::size_t index, const std::string& text) {
  try {
    polar_points(centers, radii_deg);
    FAIL() << "accepted: " << text;
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.index(), index);
    EXPECT_EQ(error.what(), text);
  }
}

TEST(polar_points, name_the_first_bad_index) {
  const std::vector<Point> points(4, Point{1, 0, 0});
  std::vector<LonLat> positions(4);
  expect_invalid(points, {0, 10, 90, -1}, 2, "site 2: radius 90 is not in [0, 90)");
  expect_invalid(positions, {0, nan, 95, 0}, 1, "site 1: radius nan is not in [0, 90)");
  expect_invalid(points, {0, -0.5, 95, 0}, 1, "site 1: radius -0.5 is not in [0, 90)");
  expect_invalid(points, {0, 1, 2}, 3, "3 radii for 4 centers");
  positions[3].lat_deg = 91;
  expect_invalid(positions, {0, 1, 2, 3}, 3, "site 3: latitude 91 is outside [-90, 90]");
  EXPECT_TRUE(polar_points(std::vector<Point>{}, {}).empty());
}

// Regular triangulations of circles against exact rational arithmetic: the surface is closed, every
// edge is locally convex, the surface surrounds the center once, and every hidden site lies in the
// cone and below the plane of its face. So it is the convex hull of the points q / cos r.

const Options weighted{.model = Model::weighted};

std::vector<Point> random_circles(std::size_t n, double min_deg, double max_deg,
                                  std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> centers(n);
  std::vector<double> radii_deg(n);
  for (std::size_t i = 0; i < n; ++i) {
    centers[i] = random_direction(random);
    radii_deg[i] = min_deg + (max_deg - min_deg) * random.unit();
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
  const double max_deg = 95 / std::sqrt(static_cast<double>(many()));  // half of their distance
  const auto sites = random_circles(many(), 0, max_deg, 2);
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

// --- power cells of circles: the cell of a site is where p.u is largest over all sites p ---

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
  const std::span<const Index> ring = cells.rings[site];
  const std::size_t count = ring.size();
  double least = count == 0 ? -1 : 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Point& a = cells.points[ring[i]];
    const Point& b = cells.points[ring[(i + 1) % count]];
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
    ASSERT_EQ(cells.rings.offsets[hidden.site], cells.rings.offsets[hidden.site + 1]);
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

std::vector<Point> random_circles(std::size_t n, double max_deg) {
  Random random(12);
  std::vector<Point> sites(n);
  for (Point& p : sites) p = polar_point(random_direction(random), max_deg * random.unit());
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
