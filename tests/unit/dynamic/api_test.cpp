// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "rondel/delaunay.h"
#include "rondel/dynamic.h"
#include "rondel/error.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const std::vector<Point> octahedron = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                       {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};

void expect_same(const Triangulation& a, const Triangulation& b) {
  EXPECT_EQ(a.dimension(), b.dimension());
  EXPECT_TRUE(std::ranges::equal(a.faces(), b.faces()));
  EXPECT_TRUE(std::ranges::equal(a.neighbors(), b.neighbors()));
  EXPECT_TRUE(std::ranges::equal(a.ghost_faces(), b.ghost_faces()));
  EXPECT_TRUE(std::ranges::equal(a.ring(), b.ring()));
  EXPECT_TRUE(std::ranges::equal(a.duplicates(), b.duplicates()));
  EXPECT_TRUE(std::ranges::equal(a.hidden(), b.hidden()));
}

std::vector<Point> random_sites(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> sites(n);
  for (Point& p : sites) p = random_direction(random);
  return sites;
}

// Calls work, which must throw with this index and message and leave everything as it was.
template <class Work>
void expect_refused(const DynamicTriangulation& changing, std::size_t index,
                    const std::string& message, Work work) {
  const Snapshot before = changing.snapshot();
  try {
    work();
    FAIL() << "nothing was thrown";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.index(), index);
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
  }
  const Snapshot after = changing.snapshot();
  EXPECT_EQ(before.ids, after.ids);
  EXPECT_TRUE(before.triangulation.sites() == after.triangulation.sites());
  expect_same(before.triangulation, after.triangulation);
}

TEST(dynamic, starts_without_sites) {
  const DynamicTriangulation changing;
  EXPECT_EQ(changing.dimension(), -1);
  EXPECT_EQ(changing.num_sites(), 0U);
  EXPECT_EQ(changing.num_vertices(), 0U);
  EXPECT_EQ(changing.num_faces(), 0U);
  EXPECT_TRUE(changing.ids().empty());
  EXPECT_FALSE(changing.contains(0));
}

TEST(dynamic, climbs_through_the_dimensions_and_back) {
  DynamicTriangulation changing;
  std::vector<int> dimensions;
  for (const Point& p : octahedron) {
    changing.insert(p);
    dimensions.push_back(changing.dimension());
  }
  EXPECT_EQ(dimensions, (std::vector<int>{0, 1, 2, 2, 2, 2}));
  EXPECT_EQ(changing.num_faces(), 8U);
  dimensions.clear();
  for (Index id = 0; id < 6; ++id) {
    changing.remove(id);
    dimensions.push_back(changing.dimension());
  }
  EXPECT_EQ(dimensions, (std::vector<int>{2, 2, 2, 1, 0, -1}));
}

TEST(dynamic, keeps_ids_and_reuses_those_of_removed_sites) {
  DynamicTriangulation changing(octahedron);
  changing.remove(2);
  EXPECT_FALSE(changing.contains(2));
  EXPECT_EQ(changing.ids(), (std::vector<Index>{0, 1, 3, 4, 5}));
  EXPECT_EQ(changing.site(5), octahedron[5]);
  EXPECT_EQ(changing.insert({1, 1, 1}), 2U);
  EXPECT_EQ(changing.insert({1, 1, 2}), 6U);
  changing.move(6, {1, 2, 1});
  EXPECT_EQ(changing.site(6), (Point{1, 2, 1}));
  EXPECT_EQ(changing.site(2), (Point{1, 1, 1}));
}

TEST(dynamic, neighbors_are_counterclockwise) {
  const DynamicTriangulation changing(octahedron);
  EXPECT_EQ(changing.neighbors(2), (std::vector<Index>{0, 1, 3, 4}));

  const DynamicTriangulation circle(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}});
  EXPECT_EQ(circle.dimension(), 1);
  EXPECT_EQ(circle.neighbors(1), (std::vector<Index>{0, 2}));
  const DynamicTriangulation pair(std::vector<Point>{{1, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(pair.neighbors(1), (std::vector<Index>{0}));
  const DynamicTriangulation single(std::vector<Point>{{1, 0, 0}});
  EXPECT_TRUE(single.neighbors(0).empty());
}

TEST(dynamic, duplicates_stay_when_one_of_them_goes) {
  DynamicTriangulation changing(octahedron);
  const Index twin = changing.insert({2, 0, 0});
  const Index triplet = changing.insert({0.5, 0, 0});
  EXPECT_EQ(changing.num_vertices(), 6U);
  EXPECT_EQ(changing.representative(twin), 0U);
  EXPECT_EQ(changing.neighbors(triplet), changing.neighbors(0));
  changing.remove(Index{0});
  EXPECT_EQ(changing.num_vertices(), 6U);
  EXPECT_EQ(changing.representative(triplet), twin);
  EXPECT_TRUE(changing.is_vertex(triplet));
  changing.remove(twin);
  changing.remove(triplet);
  EXPECT_EQ(changing.num_vertices(), 5U);
}

TEST(dynamic, hidden_sites_come_back) {
  Options options;
  options.model = Model::weighted;
  DynamicTriangulation changing(octahedron, options);
  const Index low = changing.insert({0.5, 0.5, 0.01});
  EXPECT_TRUE(changing.is_vertex(low));
  const Index high = changing.insert({5, 5, 5});
  EXPECT_FALSE(changing.is_vertex(low));
  EXPECT_TRUE(changing.neighbors(low).empty());
  // The three sites at the corner's faces stay extreme.
  EXPECT_EQ(changing.num_vertices(), 7U);
  changing.remove(high);
  EXPECT_TRUE(changing.is_vertex(low));
  EXPECT_EQ(changing.num_vertices(), 7U);
}

TEST(dynamic, refuses_what_is_not_valid_and_changes_nothing) {
  DynamicTriangulation changing(octahedron);
  expect_refused(changing, 0, "not finite", [&] { changing.insert({nan, 0, 0}); });
  expect_refused(changing, 0, "center", [&] { changing.insert({0, 0, 0}); });
  expect_refused(changing, 0, "site 77 does not exist", [&] { changing.insert({1, 1, 0}, 77); });
  expect_refused(changing, 1, "not finite", [&] {
    changing.insert(std::vector<Point>{{1, 1, 0}, {0, nan, 0}});
  });
  expect_refused(changing, 0, "site 6 does not exist", [&] { changing.remove(6); });
  expect_refused(changing, 1, "site 9 does not exist", [&] {
    changing.remove(std::vector<Index>{0, 9});
  });
  expect_refused(changing, 2, "site 1 appears twice", [&] {
    changing.remove(std::vector<Index>{1, 0, 1});
  });
  expect_refused(changing, 1, "site 3 appears twice", [&] {
    changing.remove(std::vector<Index>{3, 3, 9});
  });
  expect_refused(changing, 0, "not finite", [&] { changing.move(0, {0, 0, nan}); });
  expect_refused(changing, 0, "site 6 does not exist", [&] { changing.move(6, {1, 1, 1}); });
  expect_refused(changing, 1, "2 points for 1 sites", [&] {
    changing.move(std::vector<Index>{0}, std::vector<Point>{{1, 1, 1}, {1, 1, 2}});
  });
  expect_refused(changing, 0, "does not exist", [&] { (void)changing.site(6); });
  expect_refused(changing, 0, "does not exist", [&] { (void)changing.is_vertex(6); });
  expect_refused(changing, 0, "does not exist", [&] { (void)changing.neighbors(6); });
  expect_refused(changing, 0, "does not exist", [&] { (void)changing.representative(6); });
  Options options;
  options.sphere.squared_radius = -1;
  EXPECT_THROW(DynamicTriangulation{options}, InvalidInput);
}

TEST(dynamic, takes_and_gives_triangulations) {
  for (const Generator& kind : generators()) {
    for (const Model model : {Model::projected, Model::weighted}) {
      if (kind.weighted_only && model == Model::projected) continue;
      const SiteSet set = kind.make(kind.has_long_integers ? 30 : 200, 5);
      Options options;
      options.model = model;
      options.sphere = set.sphere;
      const Triangulation built = delaunay(set.sites, options);
      const DynamicTriangulation changing(built);
      const Snapshot now = changing.snapshot();
      EXPECT_TRUE(now.triangulation.sites() == set.sites);
      SCOPED_TRACE(kind.name);
      expect_same(now.triangulation, built);
      EXPECT_EQ(now.triangulation.model(), model);
    }
  }
}

TEST(dynamic, ranges_do_what_single_calls_do) {
  const auto sites = random_sites(500, 1);
  const auto more = random_sites(300, 2);
  DynamicTriangulation all_at_once(sites);
  DynamicTriangulation one_by_one;
  for (const Point& p : sites) one_by_one.insert(p);
  const auto ids = all_at_once.insert(more);
  for (std::size_t i = 0; i < more.size(); ++i) EXPECT_EQ(one_by_one.insert(more[i]), ids[i]);
  expect_same(all_at_once.snapshot().triangulation, one_by_one.snapshot().triangulation);

  std::vector<Index> moved;
  for (Index id = 0; id < 800; id += 3) moved.push_back(id);
  const auto places = random_sites(moved.size(), 3);
  all_at_once.move(moved, places);
  for (std::size_t i = 0; i < moved.size(); ++i) one_by_one.move(moved[i], places[i]);
  std::vector<Index> gone;
  for (Index id = 1; id < 800; id += 2) gone.push_back(id);
  all_at_once.remove(gone);
  for (const Index id : gone) one_by_one.remove(id);
  EXPECT_EQ(all_at_once.ids(), one_by_one.ids());
  expect_same(all_at_once.snapshot().triangulation, one_by_one.snapshot().triangulation);
  EXPECT_EQ(all_at_once.num_vertices(), 400U);
}

// The pole is a neighbor of every site of the first parallel: cocircular, so that all
// is decided by the perturbation.
TEST(dynamic, removes_a_vertex_of_high_degree) {
  std::vector<Point> sites = {{0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 20000; ++i) sites.push_back(unit_vector({i * 360.0 / 20000, 80}));
  DynamicTriangulation changing(sites);
  ASSERT_GT(changing.neighbors(0).size(), 19000U);
  changing.remove(Index{0});
  sites.erase(sites.begin());
  expect_same(changing.snapshot().triangulation, delaunay(sites));
}

// All sites of a curve lie below one corner; any order of insertion but a random one would make
// each of them a neighbor of most others on the way.
TEST(dynamic, many_hidden_sites_come_back_at_once) {
  Options options;
  options.model = Model::weighted;
  std::vector<Point> sites;
  for (int i = -10000; i < 10000; ++i) {
    const double t = i / 1e4;
    sites.push_back({t, t * t, t * t * t});
  }
  DynamicTriangulation changing(sites, options);
  const Triangulation built = delaunay(sites, options);
  const auto corners =
      changing.insert(std::vector<Point>{{9, 9, 9}, {-9, -9, 9}, {-9, 9, -9}, {9, -9, -9}});
  EXPECT_EQ(changing.num_vertices(), 4U);
  EXPECT_EQ(changing.snapshot().triangulation.hidden().size(), sites.size());
  changing.remove(corners);
  expect_same(changing.snapshot().triangulation, built);
}

// The star of the apex has thousands of faces, each of which hides some sites.
TEST(dynamic, one_site_hides_many_below_many_faces) {
  Options options;
  options.model = Model::weighted;
  std::vector<Point> sites = {{0, 0, -3}};
  constexpr int size = 3000;
  for (int i = 0; i < size; ++i) {
    const Point rim = unit_vector({i * 360.0 / size, 0});
    sites.push_back(rim);
    sites.push_back(unit_vector({i * 7.0, 5 + i * 80.0 / size}));
  }
  DynamicTriangulation changing(sites, options);
  const Triangulation built = delaunay(sites, options);
  const Index apex = changing.insert({0, 0, 50});
  EXPECT_EQ(changing.neighbors(apex).size(), static_cast<std::size_t>(size));
  changing.remove(apex);
  expect_same(changing.snapshot().triangulation, built);
}

// Along the circle, so that what spans it goes again and again.
TEST(dynamic, a_great_circle_is_emptied_site_by_site) {
  constexpr std::size_t size = 20000;
  for (const double start : {-135.0, 0.5, 45.0, 135.0}) {
    DynamicTriangulation changing;
    std::vector<Point> sites(size);
    for (std::size_t i = 0; i < size; ++i) {
      sites[i] = unit_vector({start + 360.0 * static_cast<double>(i) / size, 0});
    }
    const auto ids = changing.insert(sites);
    for (std::size_t i = 0; i < size - 3; ++i) changing.remove(ids[i]);
    EXPECT_EQ(changing.dimension(), 1);
    EXPECT_EQ(changing.num_vertices(), 3U);
    const Index pole = changing.insert({0, 0, 1});
    EXPECT_EQ(changing.num_faces(), 4U);
    changing.remove(pole);
    for (std::size_t i = size - 3; i < size; ++i) changing.remove(ids[i]);
    EXPECT_EQ(changing.dimension(), -1);
  }
}

TEST(dynamic, can_be_moved_as_an_object) {
  DynamicTriangulation first(octahedron);
  DynamicTriangulation second(std::move(first));
  second.insert({1, 1, 1});
  first = std::move(second);
  EXPECT_EQ(first.num_vertices(), 7U);
}

}  // namespace
}  // namespace rondel::test
