// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Ranges of changes, small ones and such that a build takes their place: the result is that of the
// same changes one by one, and so is every id that is given later.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/dynamic.h"
#include "rondel/error.h"
#include "rondel/query.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

void expect_equal(const DynamicTriangulation& ranges, const DynamicTriangulation& singles) {
  const Snapshot a = ranges.snapshot();
  const Snapshot b = singles.snapshot();
  ASSERT_EQ(a.ids, b.ids);
  EXPECT_TRUE(a.triangulation.sites() == b.triangulation.sites());
  const Triangulation& t = a.triangulation;
  const Triangulation& u = b.triangulation;
  EXPECT_TRUE(std::ranges::equal(t.faces(), u.faces()));
  EXPECT_TRUE(std::ranges::equal(t.neighbors(), u.neighbors()));
  EXPECT_TRUE(std::ranges::equal(t.ghost_faces(), u.ghost_faces()));
  EXPECT_TRUE(std::ranges::equal(t.hidden(), u.hidden()));
  EXPECT_TRUE(std::ranges::equal(t.duplicates(), u.duplicates()));
  EXPECT_TRUE(std::ranges::equal(t.ring(), u.ring()));
  EXPECT_EQ(ranges.dimension(), singles.dimension());
  EXPECT_EQ(ranges.num_sites(), singles.num_sites());
  EXPECT_EQ(ranges.num_vertices(), singles.num_vertices());
  EXPECT_EQ(ranges.num_faces(), singles.num_faces());
  for (const Index id : a.ids) {
    EXPECT_EQ(ranges.representative(id), singles.representative(id));
    EXPECT_EQ(ranges.is_vertex(id), singles.is_vertex(id));
    EXPECT_EQ(ranges.neighbors(id), singles.neighbors(id));
  }
}

std::vector<Point> sites_of(std::string_view name, std::size_t n, std::uint64_t seed) {
  std::vector<Point> sites = generator(name).make(n, seed).sites;
  sites.resize(std::min(sites.size(), n));
  return sites;
}

// Two objects that change alike, one in ranges.
class Pair {
 public:
  Pair(std::span<const Point> sites, Model model)
      : ranges_(sites, {.model = model}), singles_(sites, {.model = model}) {}

  void insert(std::span<const Point> sites) {
    std::vector<Index> ids;
    for (const Point& p : sites) ids.push_back(singles_.insert(p));
    EXPECT_EQ(ranges_.insert(sites), ids);
    expect_equal(ranges_, singles_);
  }
  // Of the ids in use, those at these positions.
  void remove(std::size_t first, std::size_t step) {
    const std::vector<Index> ids = chosen(first, step);
    for (const Index id : ids) singles_.remove(id);
    ranges_.remove(ids);
    expect_equal(ranges_, singles_);
  }
  void move(std::size_t first, std::size_t step, std::span<const Point> to) {
    std::vector<Index> ids = chosen(first, step);
    ids.resize(std::min(ids.size(), to.size()));
    if (!ids.empty()) ids.back() = ids.front();  // twice
    for (std::size_t i = 0; i < ids.size(); ++i) singles_.move(ids[i], to[i]);
    ranges_.move(ids, to.first(ids.size()));
    expect_equal(ranges_, singles_);
  }

 private:
  // Every so many, the last ones first.
  [[nodiscard]] std::vector<Index> chosen(std::size_t first, std::size_t step) const {
    const std::vector<Index> all = singles_.ids();
    std::vector<Index> ids;
    for (std::size_t i = first; i < all.size(); i += step) ids.push_back(all[i]);
    std::ranges::reverse(ids);
    return ids;
  }

  DynamicTriangulation ranges_;
  DynamicTriangulation singles_;
};

TEST(dynamic_range, equals_the_same_changes_one_by_one) {
  for (const char* name : {"uniform", "integer_sphere", "great_circle", "hemisphere", "ball"}) {
    for (const Model model : {Model::projected, Model::weighted}) {
      SCOPED_TRACE(std::string(name) + (model == Model::weighted ? ", weighted" : ", projected"));
      const std::vector<Point> sites = sites_of(name, 60, 1);
      const std::vector<Point> more = sites_of(name, 150, 2);
      const std::vector<Point> others = sites_of("uniform", 300, 3);
      Pair pair(sites, model);
      pair.insert(std::span(more).first(10));       // one by one
      pair.insert(more);                            // a build
      pair.remove(3, 7);                            // one by one
      pair.insert(std::span(others).first(20));     // takes ids that were free
      pair.move(1, 9, others);                      // one by one
      pair.move(0, 2, std::span(others).last(90));  // a build
      pair.remove(1, 2);                            // a build
      pair.insert(std::span(others).first(40));
      pair.move(0, 1, more);
      pair.remove(0, 1);  // all
      pair.insert(sites);
    }
  }
}

// A build gives the faces the numbers that they have in the canonical order. Changes one by one
// number them as they come, and leave gaps.
bool has_canonical_faces(const DynamicTriangulation& changing) {
  const Snapshot now = changing.snapshot();
  const auto faces = now.triangulation.faces();
  for (Index f = 0; f < faces.size(); ++f) {
    Triple corners = faces[f];
    for (Index& v : corners) v = now.ids[v];
    try {
      if (changing.face(f) != corners) return false;
    } catch (const InvalidInput&) {
      return false;
    }
  }
  return true;
}

TEST(dynamic_range, is_a_build_when_that_is_less_work) {
  constexpr std::size_t n = 1000;
  const std::vector<Point> sites = sites_of("uniform", n, 1);
  const std::vector<Point> others = sites_of("uniform", n, 2);
  const std::span<const Point> few = std::span(others).first(n / 20);
  const auto is_build = [&](auto change) {
    DynamicTriangulation changing(sites);
    std::vector<Index> ids = changing.ids();
    changing.insert(others[0]);
    EXPECT_FALSE(has_canonical_faces(changing));
    change(changing, ids);
    return has_canonical_faces(changing);
  };
  EXPECT_TRUE(is_build([&](auto& t, const auto& ids) { t.move(ids, others); }));
  EXPECT_FALSE(is_build([&](auto& t, auto ids) {
    ids.resize(few.size());
    t.move(ids, few);
  }));
  EXPECT_FALSE(is_build([&](auto& t, const auto& ids) { t.move(ids[0], others[0]); }));
  EXPECT_FALSE(is_build([&](auto& t, const auto& /*ids*/) { t.insert(few); }));
  EXPECT_TRUE(is_build([&](auto& t, const auto& /*ids*/) {
    std::vector<Point> many = others;
    for (const Point& p : others) many.push_back({-p.z, p.x, p.y});
    t.insert(many);
  }));
  EXPECT_TRUE(is_build([&](auto& t, auto ids) {
    ids.resize(9 * n / 10);
    t.remove(ids);
  }));
  EXPECT_FALSE(is_build([&](auto& t, auto ids) {
    ids.resize(n / 20);
    t.remove(ids);
  }));
  DynamicTriangulation empty;
  empty.insert(sites);
  EXPECT_TRUE(has_canonical_faces(empty));
}

TEST(dynamic_range, ends_the_use_of_a_locator) {
  const std::vector<Point> sites = sites_of("uniform", 200, 1);
  const std::vector<Point> others = sites_of("uniform", 200, 2);
  DynamicTriangulation changing(sites);
  const Locator locator(changing);
  EXPECT_EQ(locator.nearest(sites[17]), 17U);
  changing.move(changing.ids(), others);
  EXPECT_THROW(static_cast<void>(locator.nearest(others[0])), InvalidInput);
  EXPECT_THROW(static_cast<void>(locator.nearest(others)), InvalidInput);
  EXPECT_THROW(static_cast<void>(locator.neighbors(0)), InvalidInput);
  EXPECT_THROW(static_cast<void>(locator.conflict_region(others[0])), InvalidInput);
  const Locator next(changing);
  for (Index id = 0; id < others.size(); ++id) EXPECT_EQ(next.nearest(others[id]), id);
}

}  // namespace
}  // namespace rondel::test
