// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Changes of a DynamicTriangulation without enough memory: std::bad_alloc, no leak, and the sites
// and their triangulation are what they were before the change; then the change succeeds.

#include <algorithm>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "faults/failing_allocation.h"
#include "rondel/delaunay.h"
#include "rondel/dynamic.h"
#include "rondel/query.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

constexpr std::size_t num_sites = 18;

struct Change {
  std::string name;
  void (*make)(DynamicTriangulation& changing, const std::vector<Point>& others);
};

std::vector<Index> ids_from(Index first, Index last) {
  std::vector<Index> ids;
  for (Index id = first; id < last; ++id) ids.push_back(id);
  return ids;
}

// More than double or less than half the sites have new numbers for their places. Ranges are large
// enough for a build of all sites, or short.
const std::vector<Change> changes = {
    {"insert", [](auto& changing, const auto& others) { changing.insert(others[0]); }},
    {"insert_with_hint", [](auto& changing, const auto& others) { changing.insert(others[0], 3); }},
    {"insert_duplicate",
     [](auto& changing, const auto&) { changing.insert(0.5 * changing.site(2)); }},
    {"insert_range", [](auto& changing, const auto& others) { changing.insert(others); }},
    {"insert_short_range",
     [](auto& changing, const auto& others) {
       changing.insert(std::vector<Point>(others.begin(), others.begin() + 3));
     }},
    {"remove", [](auto& changing, const auto&) { changing.remove(1); }},
    {"remove_duplicate", [](auto& changing, const auto&) { changing.remove(num_sites); }},
    {"remove_range",
     [](auto& changing, const auto&) { changing.remove(ids_from(1, num_sites - 1)); }},
    {"remove_short_range", [](auto& changing, const auto&) { changing.remove(ids_from(1, 4)); }},
    {"remove_all", [](auto& changing, const auto&) { changing.remove(changing.ids()); }},
    {"move", [](auto& changing, const auto& others) { changing.move(4, others[0]); }},
    {"move_range",
     [](auto& changing, const auto& others) {
       const std::vector<Index> ids = {5, 6, 5};
       changing.move(ids, std::vector<Point>(others.begin(), others.begin() + 3));
     }},
    {"move_all_at_once",
     [](auto& changing, const auto& others) {
       changing.move_all(std::span(others).first(num_sites + 1));
     }},
    {"move_all",
     [](auto& changing, const auto& others) {
       const std::vector<Index> ids = ids_from(0, num_sites + 1);
       changing.move(ids, std::vector<Point>(others.begin(), others.begin() + num_sites + 1));
     }},
};

struct State {
  std::vector<Index> ids;
  Sites sites;
  std::vector<Triple> faces;
  std::vector<Hidden> hidden;
  std::vector<Duplicate> duplicates;
  friend bool operator==(const State&, const State&) = default;
};

State state_of(const DynamicTriangulation& changing) {
  const Snapshot now = changing.snapshot();
  const Triangulation& t = now.triangulation;
  return {now.ids,
          now.triangulation.sites(),
          {t.faces().begin(), t.faces().end()},
          {t.hidden().begin(), t.hidden().end()},
          {t.duplicates().begin(), t.duplicates().end()}};
}

using Case = std::tuple<std::string_view, Model>;

class AllocationOfChange : public testing::TestWithParam<Case> {
 protected:
  AllocationOfChange() {
    const auto& [name, model] = GetParam();
    SiteSet set = generator(name).make(num_sites, 1);
    sites_ = std::move(set.sites);
    sites_.resize(num_sites);
    sites_.push_back(sites_[1]);
    options_ = {.model = model, .sphere = set.sphere};
    others_ = generator("uniform").make(40, 2).sites;
    for (Point& p : others_) p = p + set.sphere.center;
    static_cast<void>(delaunay(sites_, options_));  // what oneTBB keeps from its first use on
  }

  // One attempt; tells whether an allocation failed.
  [[nodiscard]] bool attempt(const Change& change, std::size_t n, Shortage shortage) const {
    DynamicTriangulation changing(sites_, options_);
    const State before = state_of(changing);
    bool is_done = false;
    FailingAllocation failing(n, shortage);
    try {
      change.make(changing, others_);
      is_done = true;
    } catch (const std::bad_alloc&) {  // as it should be
    }
    const bool has_failed = failing.stop();
    EXPECT_TRUE(has_failed || is_done) << "threw without a reason";
    if (!is_done) {
      EXPECT_EQ(changing.num_sites(), before.ids.size());
      EXPECT_EQ(changing.ids(), before.ids);
      EXPECT_EQ(state_of(changing), before) << change.name;
      change.make(changing, others_);
    }
    const Snapshot now = changing.snapshot();
    EXPECT_TRUE(std::ranges::equal(now.triangulation.faces(),
                                   delaunay(now.triangulation.sites(), options_).faces()));
    return has_failed;
  }

  std::vector<Point> sites_;
  std::vector<Point> others_;
  Options options_;
};

TEST_P(AllocationOfChange, leaves_all_as_it_was) {
  for (const Change& change : changes) {
    SCOPED_TRACE(change.name);
    fail_each_allocation(
        [&](std::size_t n, Shortage shortage) { return attempt(change, n, shortage); });
  }
}

// Enough sites for flips, and what comes after them: the index of places is sorted when it is needed.
TEST(AllocationOfFlips, leaves_all_as_it_was) {
  const std::vector<Point> sites = generator("uniform").make(300, 3).sites;
  std::vector<Point> moved = sites;
  for (Point& p : moved) p = {p.x + 0.01 * p.y, p.y - 0.004 * p.z, p.z + 0.007 * p.x * p.y};
  const std::vector<Change> steps = {
      {"by_flips", [](auto& changing, const auto& to) { changing.move_all(to); }},
      {"insert",
       [](auto& changing, const auto&) {
         changing.insert({0.5, 0.25, -1});
       }},
  };
  static_cast<void>(delaunay(sites));
  for (const Change& step : steps) {
    SCOPED_TRACE(step.name);
    fail_each_allocation([&](std::size_t n, Shortage shortage) {
      DynamicTriangulation changing(sites);
      if (step.name == "insert") changing.move_all(moved);
      const State before = state_of(changing);
      bool is_done = false;
      FailingAllocation failing(n, shortage);
      try {
        step.make(changing, moved);
        is_done = true;
      } catch (const std::bad_alloc&) {  // as it should be
      }
      const bool has_failed = failing.stop();
      EXPECT_TRUE(has_failed || is_done) << "threw without a reason";
      if (!is_done) {
        EXPECT_EQ(state_of(changing), before);
        step.make(changing, moved);
      }
      const Snapshot now = changing.snapshot();
      EXPECT_TRUE(std::ranges::equal(now.triangulation.faces(),
                                     delaunay(now.triangulation.sites()).faces()));
      return has_failed;
    });
  }
}

INSTANTIATE_TEST_SUITE_P(sites, AllocationOfChange,
                         testing::Combine(testing::Values("uniform", "integer_sphere",
                                                          "great_circle", "hemisphere", "ball",
                                                          "cube_outside"),
                                          testing::Values(Model::projected, Model::weighted)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param)) +
                                  (std::get<1>(test.param) == Model::weighted ? "_weighted"
                                                                              : "_projected");
                         });

// A change fails, and then what every question needs.
TEST(allocation_after_failed_change, questions_throw_until_there_is_memory) {
  const std::vector<Point> sites = generator("uniform").make(num_sites, 1).sites;
  const Point more = generator("uniform").make(1, 2).sites.front();
  const State expected = state_of(DynamicTriangulation(sites));
  const auto fail_to_insert = [&](DynamicTriangulation& changing) {
    const FailingAllocation failing(1, Shortage::from_there_on);
    EXPECT_THROW(changing.insert(more), std::bad_alloc);
  };
  fail_each_allocation([&](std::size_t n, Shortage shortage) {
    DynamicTriangulation changing(sites);
    fail_to_insert(changing);
    bool is_answered = false;
    FailingAllocation failing(n, shortage);
    try {
      is_answered = changing.num_faces() == expected.faces.size();
    } catch (const std::bad_alloc&) {  // as it should be
    }
    const bool has_failed = failing.stop();
    EXPECT_TRUE(has_failed || is_answered);
    EXPECT_EQ(changing.site(2), sites[2]);
    EXPECT_EQ(state_of(changing), expected);
    return has_failed;
  });
}

TEST(allocation_after_failed_change, every_question_is_answered) {
  const std::vector<Point> sites = generator("uniform").make(num_sites, 1).sites;
  const DynamicTriangulation expected(sites);
  const auto check = [&](auto ask) {
    DynamicTriangulation changing(sites);
    FailingAllocation failing(1, Shortage::from_there_on);
    EXPECT_THROW(changing.remove(0), std::bad_alloc);
    failing.stop();
    EXPECT_TRUE(ask(changing) == ask(expected));
  };
  check([](const auto& t) { return t.dimension(); });
  check([](const auto& t) { return t.num_vertices(); });
  check([](const auto& t) { return t.num_faces(); });
  check([](const auto& t) { return t.representative(3); });
  check([](const auto& t) { return t.is_vertex(3); });
  check([](const auto& t) { return t.neighbors(3); });
  check([](const auto& t) { return t.face(0).size(); });
  check([](const auto& t) { return t.snapshot().ids; });
  check([](const auto& t) { return Locator(t).nearest(Point{1, 2, 3}); });
}

TEST(allocation_of_constructor, loses_nothing) {
  const std::vector<Point> sites = generator("uniform").make(num_sites, 1).sites;
  const Triangulation built = delaunay(sites, {}, {.threads = 1});
  expect_result_or_bad_alloc([&] { return DynamicTriangulation().num_sites(); });
  expect_result_or_bad_alloc([&] { return DynamicTriangulation(built).num_faces(); });
  const DynamicTriangulation changing(built);
  expect_result_or_bad_alloc([&] { return state_of(changing); });
  expect_result_or_bad_alloc([&] { return changing.neighbors(0); });
}

std::vector<Point> points_of_grid() {
  std::vector<Point> points;
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      for (const double z : {-1.0, 0.0, 1.0}) {
        if (Point{x, y, z} != Point{}) points.push_back({x, y, z});
      }
    }
  }
  return points;
}

// Memory runs out in a change, and again while the triangulation is built that the next question needs.
void expect_ids_of_their_own_after_failures(std::size_t first, std::size_t second) {
  SCOPED_TRACE(std::to_string(first) + ", " + std::to_string(second));
  DynamicTriangulation changing;
  for (const Point& p : points_of_grid()) changing.insert(p);
  const auto failing_at = [&](std::size_t n, const auto& work) {
    const FailingAllocation failing(n, Shortage::of_one_block);
    try {
      work();
    } catch (const std::bad_alloc&) {  // as it should be
    }
  };
  const auto along_a_line = [](double t) { return Point{0.5, 0.1 * t + 0.02, 0.7}; };
  std::vector<Point> others;
  for (int i = 0; i < 5; ++i) others.push_back(along_a_line(i));
  failing_at(first, [&] { changing.insert(others); });
  failing_at(second, [&] { static_cast<void>(changing.num_faces()); });

  for (int i = 5; i < 14; ++i) changing.insert(along_a_line(i));
  const std::vector<Index> ids = changing.ids();
  ASSERT_EQ(ids.size(), changing.num_sites());
  const Snapshot now = changing.snapshot();
  ASSERT_TRUE(
      std::ranges::equal(now.triangulation.faces(), delaunay(now.triangulation.sites()).faces()));
}

TEST(allocation_of_changes, that_fail_twice_give_no_id_away_twice) {
  for (std::size_t first = 1; first < 24; ++first) {
    for (std::size_t second = 1; second < 160; ++second) {
      ASSERT_NO_FATAL_FAILURE(expect_ids_of_their_own_after_failures(first, second));
    }
  }
}

}  // namespace
}  // namespace rondel::test
