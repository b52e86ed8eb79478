// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Queries against brute force over degenerate input of every kind, in both models.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>

#include "rondel/delaunay.h"
#include "rondel/predicates.h"
#include "rondel/query.h"
#include "support/generators.h"
#include "support/hull_oracle.h"
#include "support/query_oracle.h"

namespace rondel::test {
namespace {

struct Case {
  std::string name;
  SiteSet set;
  Triangulation triangulation;
  std::vector<Point> queries;
};

// Calls `work` for each generator and model.
void for_each_case(std::size_t n, const std::function<void(const Case&)>& work) {
  Random random(3);
  for (const Generator& generator : generators()) {
    if (generator.has_long_integers && is_shortened()) continue;
    const std::size_t most = generator.has_long_integers ? 12 : n;
    const std::size_t size = std::min(most, is_shortened() ? n / 2 : n);
    for (const Model model : {Model::projected, Model::weighted}) {
      if (generator.weighted_only && model == Model::projected) continue;
      Case c;
      c.name =
          std::string(generator.name) + (model == Model::projected ? " projected" : " weighted");
      c.set = generator.make(size, 5);
      c.triangulation = delaunay(c.set.sites, {.model = model, .sphere = c.set.sphere});
      c.queries = query_points(c.set.sites, c.set.sphere.center, random);
      work(c);
    }
  }
}

TEST(query_oracle, nearest_and_k_nearest_agree_with_brute_force) {
  for_each_case(40, [](const Case& c) {
    const Locator locator(c.triangulation);
    const QueryOracle oracle(c.triangulation, c.set.sites, c.queries);
    for (std::size_t q = 0; q < c.queries.size(); ++q) {
      const std::vector<Index> sorted = oracle.by_distance(q);
      ASSERT_EQ(locator.nearest(c.queries[q]), sorted.empty() ? no_index : sorted[0])
          << c.name << " query " << q;
      for (const std::size_t k : {std::size_t{1}, std::size_t{5}, sorted.size() + 1}) {
        const std::vector<Index> first(
            sorted.begin(),
            sorted.begin() + static_cast<std::ptrdiff_t>(std::min(k, sorted.size())));
        ASSERT_EQ(locator.k_nearest(c.queries[q], k), first) << c.name << " query " << q;
      }
    }
  });
}

TEST(query_oracle, locate_agrees_with_brute_force) {
  std::set<Where> met;
  for_each_case(40, [&met](const Case& c) {
    const Locator locator(c.triangulation);
    const QueryOracle oracle(c.triangulation, c.set.sites, c.queries);
    for (std::size_t q = 0; q < c.queries.size(); ++q) {
      const Location found = locator.locate(c.queries[q]);
      met.insert(found.where);
      ASSERT_EQ(found, oracle.locate(q)) << c.name << " query " << q;
    }
  });
  EXPECT_EQ(met.size(), 4U);
}

TEST(query_oracle, within_agrees_with_brute_force) {
  constexpr double pi = std::numbers::pi;
  const std::size_t step = is_shortened() ? 5 : 2;
  for_each_case(30, [step](const Case& c) {
    const Locator locator(c.triangulation);
    const QueryOracle oracle(c.triangulation, c.set.sites, c.queries);
    for (std::size_t q = 0; q < c.queries.size(); q += step) {
      const Point& p = c.queries[q];
      const std::vector<Index> vertices = [&] {
        auto all = oracle.by_distance(q);
        std::ranges::sort(all);
        return all;
      }();
      ASSERT_EQ(locator.within(p, pi), vertices) << c.name;
      const double some = vertices.empty() ? 1 : locator.distance(p, vertices[q % vertices.size()]);
      for (const double angle : {0.0, 1e-9, 0.3, pi / 2, 2.5, some}) {
        const std::vector<Index> found = locator.within(p, angle);
        ASSERT_TRUE(std::ranges::is_sorted(found));
        const double tolerance = angle <= pi / 2 ? 1e-15 * angle : 2e-15;
        for (const Index v : vertices) {
          const double excess = oracle.distance_minus(q, v, angle);
          if (std::abs(excess) <= tolerance && angle > 0) continue;
          const bool is_inside = angle > 0 ? excess < 0 : oracle.is_at_distance_0(q, v);
          ASSERT_EQ(std::ranges::binary_search(found, v), is_inside)
              << c.name << " query " << q << " angle " << angle << " site " << v;
        }
      }
    }
  });
}

double length(const Point& p) { return std::hypot(p.x, p.y, p.z); }

TEST(query_oracle, distances_are_accurate) {
  for_each_case(20, [](const Case& c) {
    const Locator locator(c.triangulation);
    const QueryOracle oracle(c.triangulation, c.set.sites, c.queries);
    const bool is_projected = c.triangulation.model() == Model::projected;
    for (std::size_t q = 0; q < c.queries.size(); ++q) {
      for (Index i = 0; i < c.set.sites.size(); ++i) {
        const double distance = locator.distance(c.queries[q], i);
        const double error = std::abs(oracle.distance_minus(q, i, distance));
        if (is_projected) {
          ASSERT_LE(error, 8e-16 * distance + 1e-29) << c.name << " " << distance;
          continue;
        }
        // An error e of the cosine moves the distance d by e / sin(d), and no more than sqrt(2e).
        const double cosine_error = 1e-15 * (1 + length(c.set.sites[i] - c.set.sphere.center) /
                                                     std::sqrt(c.set.sphere.squared_radius));
        ASSERT_LE(error, std::min(1.5 * std::sqrt(2 * cosine_error),
                                  1e-15 + 2 * cosine_error / std::sin(distance)))
            << c.name << " " << distance;
      }
    }
  });
}

// What an insertion changes is the definition; the triangulation with the query shows it.
TEST(query_oracle, conflict_regions_are_the_faces_that_an_insertion_removes) {
  for_each_case(25, [](const Case& c) {
    const Locator locator(c.triangulation);
    for (const Point& p : c.queries) {
      std::vector<Point> more = c.set.sites;
      more.push_back(p);
      const Triangulation after =
          delaunay(more, {.model = c.triangulation.model(), .sphere = c.set.sphere});
      const bool is_duplicate = std::ranges::any_of(
          after.duplicates(), [&](const Duplicate& d) { return d.site == c.set.sites.size(); });
      std::vector<Index> expected;
      if (c.triangulation.dimension() == 2 && !is_duplicate) {
        std::set<Triple> left;
        for (const Triple& face : after.faces()) left.insert(lowest_first(face));
        for (Index f = 0; f < c.triangulation.num_faces(); ++f) {
          if (!left.contains(lowest_first(c.triangulation.faces()[f]))) expected.push_back(f);
        }
      }
      ASSERT_EQ(locator.conflict_region(p), expected) << c.name;
    }
  });
}

TEST(query_oracle, neighbors_are_those_of_the_faces) {
  for_each_case(30, [](const Case& c) {
    const Locator locator(c.triangulation);
    std::vector<std::set<std::array<Index, 2>>> links(c.set.sites.size());
    for (const Triple& v : c.triangulation.faces()) {
      for (std::size_t i = 0; i < 3; ++i) {
        links[v[i]].insert({v[(i + 1) % 3], v[(i + 2) % 3]});
      }
    }
    for (Index i = 0; i < links.size(); ++i) {
      const std::vector<Index> found = locator.neighbors(i);
      if (c.triangulation.dimension() < 2 || links[i].empty()) continue;
      ASSERT_EQ(found.front(), *std::ranges::min_element(found));
      std::set<std::array<Index, 2>> pairs;
      for (std::size_t k = 0; k < found.size(); ++k) {
        pairs.insert({found[k], found[(k + 1) % found.size()]});
      }
      ASSERT_EQ(pairs, links[i]) << c.name << " site " << i;
    }
    for (const Duplicate& d : c.triangulation.duplicates()) {
      ASSERT_EQ(locator.neighbors(d.site), locator.neighbors(d.representative));
    }
    for (const Hidden& h : c.triangulation.hidden()) ASSERT_TRUE(locator.neighbors(h.site).empty());
  });
}

}  // namespace
}  // namespace rondel::test
