// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Laws of queries: how the answers of different questions hang together.
#include "rondel/query.h"

#include <cmath>

#include "property/property.h"
#include "support/query_oracle.h"

namespace rondel::test {
namespace {

// Sites, and one query point of any kind.
struct Question {
  Input input;
  SiteSet set;
  Triangulation triangulation;
  Point query;
};

Question any_question() {
  Question q;
  q.input = *inputs(150);
  q.set = q.input.make();
  q.triangulation = triangulate(q.set, q.input.model);
  Random random(*rc::gen::inRange<std::uint64_t>(0, 1000));
  const auto points = query_points(q.set.sites, q.set.sphere.center, random);
  q.query = points[random.below(points.size())];
  return q;
}

TEST(queries, nearest_lists_are_prefixes_of_each_other_and_in_order) {
  expect_for_all(400, [] {
    const Question q = any_question();
    const Locator locator(q.triangulation);
    const std::size_t n = q.triangulation.num_vertices();
    const std::vector<Index> all = locator.k_nearest(q.query, n);
    RC_ASSERT(all.size() == n);
    RC_ASSERT(std::set<Index>(all.begin(), all.end()).size() == n);
    const Index nearest = locator.nearest(q.query);
    const bool is_first = n == 0 ? nearest == no_index : nearest == all[0];
    RC_ASSERT(is_first);
    const std::size_t k = *rc::gen::inRange<std::size_t>(0, n + 1);
    const std::vector<Index> some = locator.k_nearest(q.query, k);
    RC_ASSERT(std::equal(some.begin(), some.end(), all.begin()));
    const QueryOracle oracle(q.triangulation, q.set.sites, std::span(&q.query, 1));
    for (std::size_t i = 1; i < n; ++i) {
      const int sign = oracle.compare(0, all[i - 1], all[i]);
      const bool is_in_order = sign > 0 || (sign == 0 && all[i - 1] < all[i]);
      RC_ASSERT(is_in_order);
    }
  });
}

TEST(queries, what_is_within_an_angle_is_a_prefix_of_the_nearest) {
  expect_for_all(400, [] {
    const Question q = any_question();
    const Locator locator(q.triangulation);
    const double angle = *rc::gen::inRange(0, 320) / 100.0;
    const std::vector<Index> inside = locator.within(q.query, angle);
    std::vector<Index> first = locator.k_nearest(q.query, inside.size());
    std::ranges::sort(first);
    RC_ASSERT(first == inside);
    const std::vector<Index> more = locator.within(q.query, 1.01 * angle);
    RC_ASSERT(std::ranges::includes(more, inside));
  });
}

TEST(queries, a_projected_site_is_nearest_to_itself) {
  expect_for_all(200, [] {
    const Question q = any_question();
    RC_PRE(q.input.model == Model::projected);
    const Locator locator(q.triangulation);
    std::vector<Index> expected(q.set.sites.size());
    std::iota(expected.begin(), expected.end(), Index{0});
    for (const Duplicate& d : q.triangulation.duplicates()) expected[d.site] = d.representative;
    RC_ASSERT(locator.nearest(q.set.sites, {.threads = 1}) == expected);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Location at = locator.locate(q.set.sites[i]);
      const bool is_there = at.where == Where::vertex && at.sites[0] == expected[i];
      const bool is_unseen = at.where == Where::outside;
      const bool is_right = is_there || is_unseen;
      RC_ASSERT(is_right);
      RC_ASSERT(locator.conflict_region(q.set.sites[i]).empty());
    }
  });
}

// A point on the sphere is beyond the plane of the face that it is in (docs/theory/location.md).
TEST(queries, a_projected_point_is_in_conflict_with_its_face) {
  expect_for_all(400, [] {
    const Question q = any_question();
    RC_PRE(q.input.model == Model::projected && q.triangulation.dimension() == 2);
    const Locator locator(q.triangulation);
    const Location at = locator.locate(q.query);
    RC_PRE(at.where == Where::face || at.where == Where::edge);
    RC_ASSERT(std::ranges::binary_search(locator.conflict_region(q.query), at.face));
  });
}

TEST(queries, the_length_of_a_query_does_not_matter) {
  expect_for_all(300, [] {
    const Question q = any_question();
    RC_PRE(q.set.sphere.center == Point{});
    const Locator locator(q.triangulation);
    const double factor = std::ldexp(1.0, *rc::gen::inRange(-20, 20));
    const Point moved = factor * q.query;
    const bool is_exact = (1 / factor) * moved == q.query;
    RC_PRE(is_exact);
    RC_ASSERT(locator.locate(moved) == locator.locate(q.query));
    RC_ASSERT(locator.k_nearest(moved, 9) == locator.k_nearest(q.query, 9));
    RC_ASSERT(locator.within(moved, 0.5) == locator.within(q.query, 0.5));
  });
}

}  // namespace
}  // namespace rondel::test
