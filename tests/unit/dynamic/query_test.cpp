// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Queries of a triangulation that changes give what queries of a copy of it give.
#include "rondel/query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <type_traits>

#include "rondel/dynamic.h"
#include "rondel/error.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

using Corners = std::array<Index, 3>;

// From the lowest id.
Corners rotated(Corners corners) {
  std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
  return corners;
}

class Comparison {
 public:
  explicit Comparison(const DynamicTriangulation& changing)
      : changing_(changing),
        now_(changing.snapshot()),
        direct_(changing),
        copy_(now_.triangulation) {}

  void run(const std::vector<Point>& queries) const {
    ASSERT_EQ(direct_.nearest(queries), named(copy_.nearest(queries)));
    ASSERT_EQ(direct_.k_nearest(queries, 4), named(copy_.k_nearest(queries, 4)));
    const auto within = direct_.within(queries, 0.5);
    const auto expected = copy_.within(queries, 0.5);
    ASSERT_EQ(within.offsets, expected.offsets);
    ASSERT_EQ(within.values, named(expected.values));
    for (const Point& p : queries) {
      ASSERT_EQ(direct_.nearest(p), name(copy_.nearest(p)));
      compare_places(p);
      compare_regions(p);
    }
    for (std::size_t i = 0; i < now_.ids.size(); ++i) {
      const auto position = static_cast<Index>(i);
      ASSERT_EQ(direct_.neighbors(now_.ids[i]), named(copy_.neighbors(position)));
      ASSERT_EQ(direct_.neighbors(now_.ids[i]), changing_.neighbors(now_.ids[i]));
      ASSERT_EQ(direct_.distance(queries[0], now_.ids[i]), copy_.distance(queries[0], position));
    }
  }

 private:
  [[nodiscard]] Index name(Index i) const { return i == no_index ? i : now_.ids[i]; }
  [[nodiscard]] std::vector<Index> named(std::vector<Index> positions) const {
    for (Index& i : positions) i = name(i);
    return positions;
  }

  void compare_places(const Point& p) const {
    const Location a = direct_.locate(p);
    Location b = copy_.locate(p);
    for (Index& i : b.sites) i = name(i);
    ASSERT_EQ(a.where, b.where);
    if (a.where == Where::face) {
      ASSERT_EQ(rotated(a.sites), rotated(b.sites));
    } else {
      ASSERT_EQ(a.sites, b.sites);
    }
    if (a.face != no_index) {
      const Triple corners = changing_.face(a.face);
      for (const Index i : a.sites) {
        ASSERT_TRUE(i == no_index || std::ranges::count(corners, i) == 1);
      }
    }
  }

  void compare_regions(const Point& p) const {
    std::set<Corners> a;
    std::set<Corners> b;
    for (const Index f : direct_.conflict_region(p)) a.insert(rotated(changing_.face(f)));
    for (const Index f : copy_.conflict_region(p)) {
      const auto& [u, v, w] = now_.triangulation.faces()[f];
      b.insert(rotated({name(u), name(v), name(w)}));
    }
    ASSERT_EQ(a, b);
  }

  const DynamicTriangulation& changing_;
  Snapshot now_;
  Locator direct_;
  Locator copy_;
};

// A locator keeps a reference to what changes, so that it may be no temporary.
static_assert(std::is_constructible_v<Locator, const DynamicTriangulation&>);
static_assert(!std::is_constructible_v<Locator, DynamicTriangulation>);

// The sites of every kind, half of them removed again, and some moved.
TEST(dynamic_query, answers_as_a_copy_does) {
  for (const Generator& kind : generators()) {
    for (const Model model : {Model::projected, Model::weighted}) {
      if (kind.weighted_only && model == Model::projected) continue;
      if (kind.has_long_integers && scaled(10) < 20) continue;
      SCOPED_TRACE(kind.name);
      const SiteSet set = kind.make(40, 3);
      Options options;
      options.model = model;
      options.sphere = set.sphere;
      DynamicTriangulation changing(set.sites, options);
      for (Index id = 0; id + 1 < set.sites.size(); id += 2) changing.remove(id);
      for (Index id = 1; id + 4 < set.sites.size(); id += 6) changing.move(id, set.sites[id + 3]);
      std::vector<Point> queries;
      Random random(7);
      for (int i = 0; i < 20; ++i) queries.push_back(set.sphere.center + random_direction(random));
      for (const Point& p : set.sites) {
        if (p != set.sphere.center) queries.push_back(p);
      }
      Comparison(changing).run(queries);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(dynamic_query, follows_the_changes) {
  DynamicTriangulation changing(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0, 0, 1}});
  const Point query = {0, 0.1, -1};
  EXPECT_EQ(Locator(changing).nearest(query), 1U);
  const Index south = changing.insert({0, 0, -1});
  EXPECT_EQ(Locator(changing).nearest(query), south);
  changing.move(south, {0, 0, 2});
  EXPECT_EQ(Locator(changing).nearest(query), 1U);
  EXPECT_EQ(Locator(changing).nearest({0, 0, 1}), 3U);
  changing.remove(3);
  EXPECT_EQ(Locator(changing).nearest({0, 0, 1}), south);
}

TEST(dynamic_query, refuses_ids_and_faces_that_do_not_exist) {
  DynamicTriangulation changing(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0, 0, 1}});
  changing.remove(2);
  const Locator locator(changing);
  EXPECT_THROW((void)locator.neighbors(2), InvalidInput);
  EXPECT_THROW((void)locator.distance({1, 0, 0}, 2), InvalidInput);
  EXPECT_THROW((void)changing.face(100), InvalidInput);
  EXPECT_EQ(locator.neighbors(3), (std::vector<Index>{0, 1}));
  const DynamicTriangulation without_sites;
  const Locator none(without_sites);
  EXPECT_EQ(none.nearest({1, 0, 0}), no_index);
}

}  // namespace
}  // namespace rondel::test
