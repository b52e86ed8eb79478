// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel/query.h: misuse, small configurations, ties, batches and threads.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/query.h"
#include "support/generators.h"

namespace rondel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// The sites of a test with their triangulation and locator.
struct Asked {
  explicit Asked(std::vector<Point> points, const Options& options = {})
      : triangulation(delaunay(std::move(points), options)),
        sites(triangulation.sites().points()) {}

  Triangulation triangulation;
  std::span<const Point> sites;
  Locator locator{triangulation};
};

std::vector<Point> octahedron() {
  return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
}

std::vector<Point> random_points(std::size_t n, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<Point> points;
  for (std::size_t i = 0; i < n; ++i) points.push_back(test::random_direction(random));
  return points;
}

Location at(Where where, Index face, std::vector<Index> sites) {
  Location location{where, face, {no_index, no_index, no_index}};
  std::ranges::copy(sites, location.sites.begin());
  return location;
}

template <class Call>
void expect_invalid(std::size_t index, const std::string& text, const Call& call) {
  try {
    call();
    FAIL() << "accepted: " << text;
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.index(), index);
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

TEST(query_misuse, names_the_first_bad_query) {
  const Asked s(octahedron());
  const std::vector<Point> bad = {{1, 2, 3}, {0, nan, 0}, {0, 0, 0}};
  const std::string text = "query 1: (0, nan, 0) is not finite";
  expect_invalid(1, text, [&] { static_cast<void>(s.locator.locate(bad)); });
  expect_invalid(1, text, [&] { static_cast<void>(s.locator.nearest(bad)); });
  expect_invalid(1, text, [&] { static_cast<void>(s.locator.k_nearest(bad, 2)); });
  expect_invalid(1, text, [&] { static_cast<void>(s.locator.within(bad, 1)); });
  const Point center = {0, 0, 0};
  const std::string no_direction = "query 0: (0, 0, 0) is the center of the sphere";
  expect_invalid(0, no_direction, [&] { static_cast<void>(s.locator.locate(center)); });
  expect_invalid(0, no_direction, [&] { static_cast<void>(s.locator.nearest(center)); });
  expect_invalid(0, no_direction, [&] { static_cast<void>(s.locator.k_nearest(center, 1)); });
  expect_invalid(0, no_direction, [&] { static_cast<void>(s.locator.within(center, 1)); });
  expect_invalid(0, no_direction, [&] { static_cast<void>(s.locator.distance(center, 0)); });
  expect_invalid(0, no_direction, [&] { static_cast<void>(s.locator.conflict_region(center)); });
  expect_invalid(0, "is not finite", [&] {
    static_cast<void>(s.locator.nearest(Point{infinity, 0, 0}));
  });
}

TEST(query_misuse, rejects_angles_sites_and_sizes_that_are_none) {
  const Asked s(octahedron());
  const Point p = {1, 2, 3};
  expect_invalid(InvalidInput::no_index, "the angle -1 is negative",
                 [&] { static_cast<void>(s.locator.within(p, -1)); });
  expect_invalid(InvalidInput::no_index, "the angle nan",
                 [&] { static_cast<void>(s.locator.within(p, nan)); });
  expect_invalid(6, "no site 6", [&] { static_cast<void>(s.locator.neighbors(6)); });
  expect_invalid(7, "no site 7", [&] { static_cast<void>(s.locator.distance(p, 7)); });
  const std::vector<Point> queries(3, p);
  const std::size_t huge = std::numeric_limits<std::size_t>::max() / 2;
  expect_invalid(InvalidInput::no_index, "is more than an array can hold",
                 [&] { static_cast<void>(s.locator.k_nearest(queries, huge)); });
}

// Whoever has the memory of viewed sites may change them: faces then lie over one another, among which
// a walk may go around, or have no inside.
int num_refused_after(const std::vector<Point>& changed) {
  std::vector<Point> sites = random_points(2000, 5);
  const Triangulation built = delaunay(Sites::view(sites));
  std::ranges::copy(changed, sites.begin());
  const Locator locator(built);
  int num_refused = 0;
  for (const Point& p : random_points(300, 7)) {
    try {
      static_cast<void>(locator.locate(p));
    } catch (const InvalidInput&) {
      ++num_refused;
    }
  }
  return num_refused;
}

TEST(query_misuse, ends_among_sites_that_were_changed) {
  EXPECT_GT(num_refused_after(random_points(2000, 6)), 0);
  EXPECT_EQ(num_refused_after(std::vector<Point>(2000, {1, 2, 3})), 300);
}

TEST(query_small, no_sites_are_an_answer) {
  const Asked s({});
  const Point p = {1, 2, 3};
  EXPECT_EQ(s.locator.locate(p), Location{});
  EXPECT_EQ(s.locator.nearest(p), no_index);
  EXPECT_TRUE(s.locator.k_nearest(p, 3).empty());
  EXPECT_TRUE(s.locator.within(p, pi).empty());
  EXPECT_TRUE(s.locator.conflict_region(p).empty());
  const std::vector<Point> queries(2, p);
  EXPECT_EQ(s.locator.k_nearest(queries, 2), std::vector<Index>(4, no_index));
  EXPECT_EQ(s.locator.within(queries, 1).offsets, (std::vector<std::uint64_t>{0, 0, 0}));
}

TEST(query_small, one_site_is_nearest_to_everything) {
  const Asked s({{0, 0, 2}, {0, 0, 3}});
  EXPECT_EQ(s.locator.nearest({1, 0, -5}), 0U);
  EXPECT_EQ(s.locator.k_nearest({1, 0, -5}, 2), std::vector<Index>{0});
  EXPECT_EQ(s.locator.locate({0, 0, 7}), at(Where::vertex, no_index, {0}));
  EXPECT_EQ(s.locator.locate({0, 0, -7}), Location{});
  EXPECT_TRUE(s.locator.neighbors(1).empty());
}

TEST(query_small, arcs_of_a_great_circle_are_edges) {
  const Asked s({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}});
  EXPECT_EQ(s.locator.locate({3, 1, 0}), at(Where::edge, no_index, {0, 1}));
  EXPECT_EQ(s.locator.locate({-1, 2, 0}), at(Where::edge, no_index, {1, 2}));
  EXPECT_EQ(s.locator.locate({0, 4, 0}), at(Where::vertex, no_index, {1}));
  EXPECT_EQ(s.locator.locate({0, -1, 0}), Location{});
  EXPECT_EQ(s.locator.locate({1, 1, 1e-300}), Location{});
  EXPECT_EQ(s.locator.nearest({0, 0, 1}), 0U);
  EXPECT_EQ(s.locator.k_nearest({-1, 0, 8}, 3), (std::vector<Index>{2, 1, 0}));
  EXPECT_EQ(s.locator.neighbors(1), (std::vector<Index>{0, 2}));
  EXPECT_TRUE(s.locator.conflict_region({0, 0, 1}).empty());
}

TEST(query_locate, tells_vertices_edges_and_faces) {
  const Asked s(octahedron());
  EXPECT_EQ(s.locator.locate({0, 0, 9}).where, Where::vertex);
  EXPECT_EQ(s.locator.locate({0, 0, 9}).sites[0], 4U);
  const Location edge = s.locator.locate({-1, 0, 5});
  EXPECT_EQ(edge.where, Where::edge);
  EXPECT_EQ(edge.sites, (std::array<Index, 3>{1, 4, no_index}));
  const Location face = s.locator.locate({-1, 2, -3});
  EXPECT_EQ(face.where, Where::face);
  EXPECT_EQ(face.sites, s.triangulation.faces()[face.face]);
}

TEST(query_locate, is_outside_where_the_center_sees_no_face) {
  const Asked s({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_EQ(s.locator.locate({1, 1, 1}).where, Where::face);
  EXPECT_EQ(s.locator.locate({1, 1, 0}).where, Where::edge);
  EXPECT_EQ(s.locator.locate({1, 1, -1e-300}), Location{});
  EXPECT_EQ(s.locator.locate({-1, -1, -1}), Location{});
}

TEST(query_nearest, gives_ties_to_the_smallest_index) {
  std::vector<Point> sites = octahedron();
  std::ranges::reverse(sites);
  const Asked s(sites);
  EXPECT_EQ(s.locator.nearest({1, 1, 1}), 1U);
  EXPECT_EQ(s.locator.k_nearest({1, 1, 1}, 6), (std::vector<Index>{1, 3, 5, 0, 2, 4}));
  EXPECT_EQ(s.locator.k_nearest({0, 0, -1}, 3), (std::vector<Index>{0, 2, 3}));
}

TEST(query_nearest, names_the_representative_of_duplicates) {
  const Asked s({{0, 0, 3}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, {2, 0, 0}});
  EXPECT_EQ(s.locator.nearest({0, 0, 1}), 0U);
  EXPECT_EQ(s.locator.nearest({5, 0, 0}), 1U);
  EXPECT_EQ(s.locator.within({1, 0, 0}, 0), std::vector<Index>{1});
  EXPECT_TRUE(s.locator.conflict_region({9, 0, 0}).empty());
}

TEST(query_weighted, the_nearest_site_owns_the_power_cell) {
  // A large circle and a small one inside it, which is hidden.
  const double scale = 1 / std::cos(pi / 3);
  const Asked s(
      {{scale, 0, 0}, {1, 0.01, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {.model = Model::weighted});
  ASSERT_EQ(s.triangulation.hidden().size(), 1U);
  EXPECT_EQ(s.locator.nearest({1, 0.01, 0}), 0U);
  EXPECT_EQ(s.locator.within({1, 0.9, 0}, 0), std::vector<Index>{0});
  EXPECT_EQ(s.locator.distance({1, 0.9, 0}, 0), 0);
  EXPECT_NEAR(s.locator.distance({1, 0, 0}, 3), pi / 2, 1e-15);
  EXPECT_TRUE(s.locator.conflict_region({1, 0.02, 0}).empty());
  EXPECT_TRUE(s.locator.conflict_region({0, 0, 0}).empty());
  EXPECT_FALSE(s.locator.conflict_region({0, 3, 0}).empty());
}

// All kinds of batches, long enough that threads start, on sites with ties and hidden ones.
struct Answers {
  std::vector<Location> places;
  std::vector<Index> nearest;
  std::vector<Index> k_nearest;
  CompressedRows<Index> within;
};

Answers answer(const Locator& locator, std::span<const Point> queries, unsigned threads) {
  const Execution execution{.threads = threads};
  return {locator.locate(queries, execution), locator.nearest(queries, execution),
          locator.k_nearest(queries, 3, execution), locator.within(queries, 0.2, execution)};
}

void expect_equal(const Answers& a, const Answers& b) {
  EXPECT_EQ(a.places, b.places);
  EXPECT_EQ(a.nearest, b.nearest);
  EXPECT_EQ(a.k_nearest, b.k_nearest);
  EXPECT_EQ(a.within.offsets, b.within.offsets);
  EXPECT_EQ(a.within.values, b.within.values);
}

std::vector<Point> many_queries() {
  std::vector<Point> queries = random_points(15000, 8);
  test::Random random(9);
  for (int i = 0; i < 3000; ++i) {
    queries.push_back({static_cast<double>(random.between(-2, 2)),
                       static_cast<double>(random.between(-2, 2)),
                       static_cast<double>(random.between(1, 3))});
  }
  return queries;
}

TEST(query_batch, equals_single_queries) {
  const std::vector<Point> queries = many_queries();
  for (const Model model : {Model::projected, Model::weighted}) {
    const Asked s(test::generator("globe_grid").make(400, 1).sites, {.model = model});
    const Answers answers = answer(s.locator, queries, 1);
    for (std::size_t i = 0; i < queries.size(); i += 7) {
      ASSERT_EQ(answers.places[i], s.locator.locate(queries[i]));
      ASSERT_EQ(answers.nearest[i], s.locator.nearest(queries[i]));
      const auto row = std::span(answers.k_nearest).subspan(3 * i, 3);
      ASSERT_TRUE(std::ranges::equal(row, s.locator.k_nearest(queries[i], 3)));
      const auto list = answers.within[i];
      ASSERT_TRUE(std::ranges::equal(list, s.locator.within(queries[i], 0.2)));
    }
  }
}

TEST(query_batch, does_not_depend_on_the_number_of_threads) {
  const std::vector<Point> queries = many_queries();
  for (const Model model : {Model::projected, Model::weighted}) {
    const Asked s(test::generator("globe_grid").make(400, 1).sites, {.model = model});
    expect_equal(answer(s.locator, queries, 4), answer(s.locator, queries, 1));
  }
}

// Every function at once on one locator; ties make them climb to the last rungs.
TEST(query_batch, may_be_asked_by_many_threads_at_once) {
  const std::vector<Point> queries = many_queries();
  for (const Model model : {Model::projected, Model::weighted}) {
    const Asked s(test::generator("globe_grid").make(400, 1).sites, {.model = model});
    const Answers expected = answer(s.locator, queries, 1);
    std::vector<Answers> answers(3);
    {
      std::vector<std::jthread> threads;
      for (Answers& a : answers) {
        threads.emplace_back([&] {
          a = answer(s.locator, queries, 2);
          for (std::size_t i = 0; i < queries.size(); i += 50) {
            static_cast<void>(s.locator.conflict_region(queries[i]));
            static_cast<void>(s.locator.neighbors(static_cast<Index>(i % s.sites.size())));
          }
        });
      }
    }
    for (const Answers& a : answers) expect_equal(a, expected);
  }
}

TEST(query_batch, fills_up_what_is_missing) {
  const Asked s({{1, 0, 0}, {0, 1, 0}});
  const std::vector<Point> queries = {{1, 2, 0}, {2, 1, 0}};
  EXPECT_EQ(s.locator.k_nearest(queries, 3), (std::vector<Index>{1, 0, no_index, 0, 1, no_index}));
  EXPECT_TRUE(s.locator.k_nearest(queries, 0).empty());
}

TEST(query_batch, a_locator_may_be_moved) {
  const Asked s(octahedron());
  Locator from(s.triangulation);
  Locator to = std::move(from);
  EXPECT_EQ(to.nearest({0, 0, 1}), 4U);
  const Asked one({{1, 0, 0}});
  Locator other(one.triangulation);
  other = std::move(to);
  EXPECT_EQ(other.nearest({0, 0, 1}), 4U);
}

// A dense patch, where directions differ by a few ulp: the walk from the far side ends, and
// the same as brute force in double-double.
TEST(query_nearest, works_among_sites_a_few_ulp_apart) {
  std::vector<Point> sites = octahedron();
  for (int i = 0; i < 40; ++i) sites.push_back({1, i * 0x1p-52, (i * 7 % 40) * 0x1p-52});
  const Asked s(sites);
  for (Index i = 6; i < sites.size(); ++i) EXPECT_EQ(s.locator.nearest(sites[i]), i == 6 ? 0U : i);
}

}  // namespace
}  // namespace rondel
