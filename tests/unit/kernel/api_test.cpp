// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel/delaunay.h: misuse, small and flat configurations, what the result says of itself.

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "kernel/conflict_test.h"
#include "models/projected_points.h"
#include "predicates/orientation.h"
#include "predicates/rung.h"
#include "rondel/delaunay.h"
#include "rondel/dynamic.h"
#include "rondel/error.h"
#include "rondel/hull.h"
#include "support/generators.h"

namespace rondel {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_invalid(const std::vector<Point>& sites, const Options& options, std::size_t index,
                    const std::string& text, const Execution& execution = {}) {
  try {
    delaunay(sites, options, execution);
    FAIL() << "accepted: " << text;
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.index(), index);
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

TEST(delaunay_misuse, names_the_first_bad_site) {
  const Point good = {1, 0, 0};
  expect_invalid({good, {0, nan, 0}, {nan, 0, 0}}, {}, 1, "site 1: (0, nan, 0) is not finite");
  expect_invalid({good, good, {0, 0, -infinity}}, {}, 2, "site 2: (0, 0, -inf) is not finite");
  expect_invalid({good, {0, 0, 0}}, {}, 1, "is the center");
  Options options;
  options.sphere.center = {1, 2, 3};
  expect_invalid({good, {1, 2, 3}}, options, 1, "is the center");
  options.model = Model::weighted;
  EXPECT_EQ(delaunay(std::vector<Point>{good, {1, 2, 3}}, options).dimension(), 1);
}

// Threads look at pieces of the input in any order.
TEST(delaunay_misuse, names_the_first_bad_site_of_many_whatever_the_threads) {
  test::Random random(10);
  std::vector<Point> sites;
  for (int i = 0; i < 100000; ++i) sites.push_back(test::random_direction(random));
  const auto expect_first = [&sites](Model model, std::size_t index) {
    for (const unsigned threads : {1U, 5U}) {
      expect_invalid(sites, {.model = model}, index, "site " + std::to_string(index) + ": ",
                     {.threads = threads});
    }
  };
  sites[99000] = {0, nan, 0};
  expect_first(Model::projected, 99000);
  expect_first(Model::weighted, 99000);
  sites[50000] = {};  // the center
  expect_first(Model::projected, 50000);
  expect_first(Model::weighted, 99000);
  sites[256] = {1, 0, infinity};
  expect_first(Model::projected, 256);
  expect_first(Model::weighted, 256);
}

TEST(delaunay_misuse, rejects_spheres_that_are_none) {
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    Options options;
    options.sphere.squared_radius = bad;
    expect_invalid({{1, 0, 0}}, options, 0, "squared radius");
  }
  Options options;
  options.sphere.center.y = infinity;
  expect_invalid({{1, 0, 0}}, options, 0, "center");
}

TEST(delaunay_misuse, rejects_arrays_that_hold_no_whole_points) {
  const std::vector<double> xyz = {1, 0, 0, 0, 1};
  EXPECT_THROW(delaunay(xyz), InvalidInput);
  EXPECT_EQ(delaunay(std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1}).num_faces(), 2U);
}

TEST(delaunay_misuse, rejects_latitudes_beyond_the_poles) {
  const std::vector<LonLat> bad = {{0, 90}, {0, 90.001}};
  EXPECT_THROW(unit_vectors(bad), InvalidInput);
  EXPECT_THROW(unit_vectors(std::vector<LonLat>{{nan, 0}}), InvalidInput);
  EXPECT_THROW(unit_vectors(std::vector<LonLat>{{0, nan}}), InvalidInput);
}

TEST(delaunay_small, every_number_of_sites_is_an_answer) {
  EXPECT_EQ(delaunay(std::vector<Point>{}).dimension(), -1);

  const Triangulation one = delaunay(std::vector<Point>{{0, 0, 2}, {0, 0, 3}});
  EXPECT_EQ(one.dimension(), 0);
  EXPECT_EQ(one.num_vertices(), 1U);
  ASSERT_EQ(one.duplicates().size(), 1U);
  EXPECT_EQ(one.duplicates()[0], (Duplicate{1, 0}));

  const Triangulation two = delaunay(std::vector<Point>{{0, 0, 2}, {0, 0, -3}});
  EXPECT_EQ(two.dimension(), 1);
  EXPECT_EQ(two.ring().size(), 2U);

  const Triangulation three = delaunay(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_EQ(three.dimension(), 2);
  EXPECT_EQ(three.num_faces(), 2U);
  EXPECT_EQ(three.num_ghost_faces(), 1U);
  EXPECT_EQ(three.neighbors()[0], (Triple{1, 1, 1}));

  const Triangulation circle =
      delaunay(std::vector<Point>{{1, 0, 0}, {0, -1, 0}, {-1, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(circle.dimension(), 1);
  EXPECT_EQ(circle.num_faces(), 0U);
  const std::vector<Index> ring(circle.ring().begin(), circle.ring().end());
  // Counterclockwise seen from +z: east, north, west, south, from some start on.
  const std::vector<Index> ccw = {0, 3, 2, 1};
  const auto start = std::ranges::find(ccw, ring[0]) - ccw.begin();
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(ring[i], ccw[(static_cast<std::size_t>(start) + i) % 4]);
  }
}

TEST(delaunay_small, octahedron_surrounds_the_center_though_no_four_of_its_vertices_do) {
  const std::vector<Point> sites = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                    {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  const Triangulation t = delaunay(sites);
  EXPECT_EQ(t.num_faces(), 8U);
  EXPECT_EQ(t.num_ghost_faces(), 0U);
}

TEST(delaunay_small, weighted_sites_below_the_surface_are_hidden_under_a_face) {
  const std::vector<Point> sites = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},    {0, -1, 0},
                                    {0, 0, 1}, {0, 0, -1}, {.1, .2, .3}, {0, 0, 0}};
  Options options;
  options.model = Model::weighted;
  const Triangulation t = delaunay(sites, options);
  ASSERT_EQ(t.hidden().size(), 2U);
  EXPECT_EQ(t.hidden()[0].site, 6U);
  EXPECT_EQ(t.hidden()[1].site, 7U);
  Triple corners = t.faces()[t.hidden()[0].face];
  std::ranges::sort(corners);
  EXPECT_EQ(corners, (Triple{0, 2, 4}));
}

TEST(delaunay_large, sites_crowded_in_a_patch_are_all_vertices) {
  test::Random random(11);
  std::vector<Point> sites;
  const Point pole = test::normalized({0.6, 0.1, 0.8});
  for (int i = 0; i < 20000; ++i) sites.push_back(test::random_near(random, pole, 1e-6));
  for (int i = 0; i < 100; ++i) sites.push_back(test::random_direction(random));
  const Triangulation t = delaunay(sites);
  EXPECT_EQ(t.num_vertices(), sites.size() - t.duplicates().size());
  EXPECT_EQ(t.num_faces(), 2 * t.num_vertices() - 4);
  EXPECT_EQ(t.num_ghost_faces(), 0U);
  const Tally& rungs = t.report().rungs;
  EXPECT_GT(rungs.filter, 100 * (rungs.extended + rungs.double_double));
}

// Closer than the longest of the machine's numbers can tell; hardly any of them needs integers.
TEST(projected_points, double_doubles_decide_for_sites_within_1e_12) {
  test::Random random(31);
  const Point pole = test::normalized({0.6, 0.1, 0.8});
  const std::vector<Index> order = {0, 1, 2, 3};
  Tally sum;
  for (int i = 0; i < 200; ++i) {
    std::vector<Point> points;
    for (int k = 0; k < 4; ++k) points.push_back(test::random_near(random, pole, 1e-12));
    models::ProjectedPoints sites(points, order, {});
    const bool is_turned = predicates::orientation(sites, 0, 1, 2).sign == Sign::negative;
    kernel::ConflictTest test(sites);
    static_cast<void>(
        test.is_in_conflict({0, is_turned ? Index{2} : 1, is_turned ? Index{1} : 2}, 3));
    predicates::add(sum, test.tally());
  }
  EXPECT_GT(sum.double_double, 50U);
  EXPECT_LT(sum.exact, 5U);
}

TEST(delaunay_progress, is_told_in_stages_that_begin_and_end) {
  test::Random random(12);
  std::vector<Point> sites;
  for (int i = 0; i < 1000; ++i) sites.push_back(test::random_direction(random));
  std::vector<std::pair<std::string, double>> calls;
  const Progress progress = [&calls](std::string_view stage, double fraction) {
    calls.emplace_back(stage, fraction);
  };
  delaunay(sites, {}, {.progress = progress});
  ASSERT_GE(calls.size(), 3U);
  EXPECT_EQ(calls.front().first, "order");
  EXPECT_EQ(calls.back(), (std::pair<std::string, double>("triangulate", 1)));
}

// The memory of these sites may not even be read.
TEST(delaunay, more_sites_than_indices_are_refused_before_they_are_read) {
  constexpr std::size_t count = std::size_t{1} << 32;
  void* const memory = ::mmap(nullptr, count * sizeof(Point), PROT_NONE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) GTEST_SKIP() << "addresses are limited";
  const std::span<const Point> sites(static_cast<const Point*>(memory), count);
  DynamicTriangulation changing;
  const auto expect_refused = [](const auto& action) {
    try {
      action();
      ADD_FAILURE() << "accepted";
    } catch (const InvalidInput& error) {
      EXPECT_EQ(std::string(error.what()), "4294967296 sites are more than the " +
                                               std::to_string(max_sites) +
                                               " that one triangulation can hold");
      EXPECT_EQ(error.index(), max_sites);
    }
  };
  expect_refused([&] { delaunay(sites, {}); });
  expect_refused([&] { convex_hull(sites); });
  expect_refused([&] { static_cast<void>(changing.insert(sites)); });
  EXPECT_EQ(changing.num_sites(), 0U);
  ::munmap(memory, count * sizeof(Point));
}

}  // namespace
}  // namespace rondel
