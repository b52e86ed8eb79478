// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <numbers>

#include "dual/local_ring.h"
#include "dual/parts.h"
#include "dual/split_sites.h"
#include "support/mpfr_oracle.h"
#include "unit/dual/support.h"

namespace rondel::test {
namespace {

constexpr double sphere_area = 4 * std::numbers::pi;

std::vector<double> areas_of(std::span<const Point> sites, Model model = Model::projected) {
  const Triangulation triangulation = triangulated(sites, model);
  return areas(triangulation);
}

// A cell of which one side is a billionth of the other cannot be better than its circumcenters,
// so what counts is the larger of a relative and an absolute error.
void expect_right_areas(const DualCase& c, double relative, double absolute) {
  const Diagram both = diagram(c.triangulation);
  const auto result = areas(c.triangulation);
  const DualOracle oracle(c.triangulation, c.sites);
  for (Index i = 0; i < c.sites.size(); ++i) {
    if (ring_of(both.cells, i).empty() || result[i] == 0) continue;
    const double exact = polygon_area(oracle.ring(both.cells, i)).rounded();
    const double allowed = std::max(relative * exact, absolute);
    EXPECT_NEAR(result[i], exact, allowed) << c.name << " site " << i;
    EXPECT_NEAR(both.areas[i], exact, allowed) << c.name << " site " << i;
  }
}

TEST(areas, agree_with_long_numbers_for_every_generator) {
  for_each_case(12, 2, [](const DualCase& c) { expect_right_areas(c, 1e-14, 1e-15); });
}

TEST(areas, sum_to_the_sphere_for_every_generator) {
  for_each_case(60, 3, [](const DualCase& c) {
    if (c.triangulation.dimension() < 0) return;
    const auto result = areas(c.triangulation);
    EXPECT_NEAR(sum_of(result) / sphere_area, 1, 1e-13) << c.name;
    for (const double a : result) EXPECT_GE(a, 0) << c.name;
  });
}

// The areas of all cells, each by a walk around it.
std::vector<double> areas_around_cells(const Triangulation& t, const Cells& cells) {
  if (t.dimension() < 2) return areas(t);
  const dual::SplitSites sites(t, 1);
  dual::RingLocalizer localize(t, sites, cells);
  std::vector<double> result(t.num_sites());
  for (Index rank = 0; rank < sites.order().size(); ++rank) {
    result[sites.order()[rank]] = dual::careful_area(localize, rank);
  }
  return result;
}

// areas() and diagram() add up kites of faces where these are right.
TEST(diagram, has_the_cells_and_areas_of_the_single_calls) {
  for_each_case(60, 3, [](const DualCase& c) {
    const Cells expected = cells(c.triangulation);
    const auto expected_areas = areas_around_cells(c.triangulation, expected);
    const Diagram both = diagram(c.triangulation);
    EXPECT_EQ(both.cells.rings, expected.rings) << c.name;
    EXPECT_EQ(both.cells.points, expected.points) << c.name;
    ASSERT_EQ(both.areas.size(), expected_areas.size());
    for (std::size_t i = 0; i < expected_areas.size(); ++i) {
      EXPECT_NEAR(both.areas[i], expected_areas[i], 1e-13 * expected_areas[i]) << c.name;
    }
    if (c.triangulation.dimension() >= 0) {
      EXPECT_NEAR(sum_of(both.areas) / sphere_area, 1, 1e-13) << c.name;
    }
  });
}

TEST(areas, sum_to_the_sphere_for_many_sites) {
  for (const char* name : {"uniform", "patch_and_globe", "globe_grid", "s_n"}) {
    const auto sites = generator(name).make(50000, 1).sites;
    EXPECT_NEAR(sum_of(areas_of(sites)) / sphere_area, 1, 1e-12) << name;
  }
}

TEST(areas, are_relatively_right_in_tiny_patches) {
  for (const char* name : {"patch_1e_6", "patch_1e_9", "patch_1e_12", "patch_and_globe"}) {
    for (const Model model : {Model::projected, Model::weighted}) {
      const DualCase c = make_case(generator(name), 40, 1, model);
      expect_right_areas(c, 1e-13, 0);
    }
  }
}

// Sites 1e-28 radians apart or more, as diagram.h promises.
TEST(areas, are_relatively_right_as_far_as_promised) {
  for (const double size : {1e-18, 1e-22, 1e-26}) {
    std::vector<Point> sites = octahedron();
    const double step = size / 16;
    for (int i = 0; i < 40; ++i) {
      sites.push_back({step * ((i * 7) % 17 - 8.5), step * ((i * 11) % 19 - 9.5), 1});
    }
    const DualCase c = {"patch", sites, triangulated(sites)};
    expect_right_areas(c, 1e-13, 0);
    for (const double area : areas(c.triangulation)) EXPECT_GT(area, 0) << size;
  }
}

// Slivers, right angles and circumcenters up to 60 degrees away: where kites are large and cancel.
TEST(diagram, has_right_areas_around_bad_triangles) {
  for (const double width : {1e-1, 1e-4, 1e-8, 1e-12}) {
    std::vector<Point> sites = octahedron();
    for (int i = 0; i < 8; ++i) {
      const double t = 0.1 * i;
      sites.push_back({std::cos(t), std::sin(t), width * ((i * 5) % 7)});
      sites.push_back({std::cos(t), std::sin(t) + width, 0.5});
    }
    expect_right_areas({"slivers", sites, triangulated(sites)}, 1e-14, 1e-15);
  }
}

TEST(areas, of_the_platonic_solids_are_equal) {
  constexpr double tolerance = 4e-15;
  for (const double a : areas_of(octahedron())) EXPECT_NEAR(a, sphere_area / 6, tolerance);
  for (const Model model : {Model::projected, Model::weighted}) {
    for (const double a : areas_of(cube(), model)) EXPECT_NEAR(a, sphere_area / 8, tolerance);
  }
}

TEST(areas, below_dimension_2_are_those_of_lunes) {
  EXPECT_EQ(areas_of(std::vector<Point>{{1, 2, 3}}), std::vector<double>{sphere_area});
  EXPECT_EQ(areas_of(std::vector<Point>{{1, 0, 0}, {1, 1e-9, 0}, {2, 0, 0}}),
            (std::vector<double>{sphere_area / 2, sphere_area / 2, 0}));
  const auto quarter = areas_of(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}});
  for (const double a : quarter) EXPECT_DOUBLE_EQ(a, std::numbers::pi);
}

TEST(areas, of_thin_lunes_are_relatively_right) {
  for (const double h : {1e-3, 1e-9, 1e-100}) {
    const std::vector<Point> sites = {{1, -h, 0}, {1, 0, 0}, {1, h, 0}};
    const auto result = areas_of(sites);
    EXPECT_NEAR(result[1] / (2 * std::atan(h)), 1, 4 * ulp) << h;
    EXPECT_NEAR(sum_of(result), sphere_area, 8 * ulp * sphere_area);
  }
}

// The angles between these rays are below the smallest double; the outer two share the sphere.
TEST(areas, of_rays_that_doubles_cannot_tell_apart_sum_to_the_sphere) {
  const std::vector<Point> sites = {{5, 0, 0}, {20, 0, 1e-323}, {20, 0, -5e-324}};
  const auto result = areas_of(sites);
  EXPECT_EQ(result[0], 0);
  EXPECT_EQ(result[1], sphere_area / 2);
  EXPECT_EQ(result[2], sphere_area / 2);
}

TEST(areas, of_hidden_and_duplicate_sites_are_zero) {
  std::vector<Point> sites = cube();
  sites.push_back({0.5, 0.25, 0});
  sites.push_back({1, 1, 1});
  const auto result = areas_of(sites, Model::weighted);
  EXPECT_EQ(result[8], 0);
  EXPECT_EQ(result[9], 0);
}

TEST(areas, do_not_depend_on_the_number_of_threads) {
  for (const char* name : {"uniform", "hemisphere"}) {
    const auto sites = generator(name).make(20000, 1).sites;
    const Triangulation t = triangulated(sites);
    EXPECT_EQ(areas(t, {.threads = 1}), areas(t, {.threads = 4}));
    const Diagram first = diagram(t, {.threads = 1});
    const Diagram second = diagram(t, {.threads = 4});
    EXPECT_EQ(first.areas, second.areas) << name;
    EXPECT_EQ(first.cells.rings, second.cells.rings) << name;
    EXPECT_EQ(first.cells.points, second.cells.points) << name;
  }
}

}  // namespace
}  // namespace rondel::test
