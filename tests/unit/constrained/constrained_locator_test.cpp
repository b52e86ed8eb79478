// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// ConstrainedLocator beside exact orientations with all faces.
#include "rondel/constrained_locator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/predicates.h"
#include "support/generators.h"
#include "support/thrown.h"

namespace rondel::test::of_constrained_locator {
namespace {

using Ends = std::array<Index, 2>;

// The location by the signs of a query and all edges: the first solid face that has it.
Location expected_location(const Triangulation& t, const Point& query) {
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (t.is_ghost(f)) continue;
    const Triple& face = t.faces()[f];
    std::array<Sign, 3> side{};
    for (unsigned i = 0; i < 3; ++i) {
      side[i] = orientation(t.sites()[face[(i + 1) % 3]], t.sites()[face[(i + 2) % 3]], query,
                            t.sphere());
    }
    if (std::ranges::count(side, Sign::negative) > 0) continue;
    const auto zeros = std::ranges::count(side, Sign::zero);
    if (zeros == 0) return {Where::face, f, face};
    if (zeros == 1) {
      const auto i = static_cast<std::size_t>(std::ranges::find(side, Sign::zero) - side.begin());
      const auto [low, high] = std::minmax(face[(i + 1) % 3], face[(i + 2) % 3]);
      return {Where::edge, f, {low, high, no_index}};
    }
    const auto i = static_cast<std::size_t>(std::ranges::find(side, Sign::positive) - side.begin());
    return {Where::vertex, f, {face[i], no_index, no_index}};
  }
  return {};
}

// Constraints that do not cross, many of them long: so that many faces are far from Delaunay.
std::vector<Ends> long_constraints(const SiteSet& set, std::size_t wanted, Random& random) {
  std::vector<Ends> constraints;
  for (std::size_t k = 0; k < wanted; ++k) {
    constraints.push_back({static_cast<Index>(random.below(set.sites.size())),
                           static_cast<Index>(random.below(set.sites.size()))});
    try {
      static_cast<void>(constrained_delaunay(set.sites, constraints, {.sphere = set.sphere}));
    } catch (const InvalidInput&) {
      constraints.pop_back();
    }
  }
  return constraints;
}

std::vector<Point> queries_of(const SiteSet& set, Random& random) {
  const Point& center = set.sphere.center;
  std::vector<Point> queries;
  for (std::size_t k = 0; k < 60; ++k) {
    const Point& p = set.sites[random.below(set.sites.size())];
    const Point& q = set.sites[random.below(set.sites.size())];
    queries.push_back(p);
    queries.push_back(center + random_direction(random));
    queries.push_back(0.5 * p + 0.5 * q);
    queries.push_back(center + (center - p));
  }
  std::erase_if(queries, [&](const Point& p) {
    return p == center || !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z);
  });
  return queries;
}

void expect_locations(const SiteSet& set, const std::vector<Ends>& constraints,
                      const std::vector<Point>& queries) {
  const auto result = constrained_delaunay(set.sites, constraints, {.sphere = set.sphere});
  const ConstrainedLocator locator(result);
  const std::vector<Location> found = locator.locate(queries, {.threads = 2});
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (result.triangulation.dimension() < 2) {
      ASSERT_EQ(found[i], Locator(result.triangulation).locate(queries[i]));
      continue;
    }
    ASSERT_EQ(found[i], expected_location(result.triangulation, queries[i])) << "query " << i;
    ASSERT_EQ(found[i], locator.locate(queries[i])) << "query " << i;
  }
}

TEST(constrained_locator, finds_the_face_that_has_a_point_for_all_kinds_of_sites) {
  Random random(11);
  for (const Generator& kind : generators()) {
    if (kind.weighted_only) continue;
    for (const std::size_t n : {4U, 12U, 60U}) {
      SCOPED_TRACE(std::string(kind.name) + " " + std::to_string(n));
      const SiteSet set = kind.make(n, n);
      if (set.sites.empty()) continue;
      const auto constraints = long_constraints(set, n, random);
      ASSERT_NO_FATAL_FAILURE(expect_locations(set, constraints, queries_of(set, random)));
    }
  }
}

// Between long rows of constraints a walk towards the query would go in circles.
TEST(constrained_locator, goes_through_rows_of_constraints) {
  Random random(12);
  for (const int num_rows : {2, 7, 30}) {
    SiteSet set;
    std::vector<Ends> constraints;
    for (int row = 0; row < num_rows; ++row) {
      const double y = 1e-3 * row;
      const auto first = static_cast<Index>(set.sites.size());
      set.sites.push_back({1, y, -1});
      set.sites.push_back({1, y, 1});
      constraints.push_back({first, first + 1});
      for (int i = 0; i < 5; ++i) {
        set.sites.push_back({1, y + 1e-3 * random.unit(), random.signed_unit()});
      }
    }
    ASSERT_NO_FATAL_FAILURE(expect_locations(set, constraints, queries_of(set, random)));
  }
}

TEST(constrained_locator, agrees_with_a_locator_without_constraints) {
  const SiteSet set = generator("uniform").make(3'000, 5);
  const auto result = constrained_delaunay(set.sites, {});
  const std::vector<Point> queries = generator("uniform").make(5'000, 6).sites;
  EXPECT_EQ(ConstrainedLocator(result).locate(queries),
            Locator(result.triangulation).locate(queries));
}

TEST(constrained_locator, names_what_it_refuses) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  ConstrainedTriangulation result = constrained_delaunay(sites, std::vector<Ends>{{0, 1}});
  const ConstrainedLocator locator(result);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(thrown_index([&] {
              return locator.locate(std::vector<Point>{{1, 0, 0}, {0, nan, 0}});
            }),
            1U);
  EXPECT_EQ(thrown_index([&] { return locator.locate(Point{0, 0, 0}); }), 0U);
  EXPECT_EQ(ConstrainedLocator(constrained_delaunay(std::vector<Point>{}, {})).locate({1, 0, 0}),
            Location());
  result.sides.pop_back();
  EXPECT_EQ(thrown_message<InvalidInput>([&] { return ConstrainedLocator(result); }),
            "there are sides for 3 faces, but there are 4 faces");
}

}  // namespace
}  // namespace rondel::test::of_constrained_locator
