// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// ConstrainedLocator beside exact orientations with all faces.
#include "rondel/constrained_locator.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "support/generators.h"
#include "support/thrown.h"
#include "unit/constrained/constrained_queries.h"

namespace rondel::test::of_constrained_locator {
namespace {

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
