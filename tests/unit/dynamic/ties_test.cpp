// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Counts how much of a facet changes when cocircular sites are inserted in order, and how many
// neighbors they have (docs/theory/perturbation.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/dynamic.h"
#include "rondel/error.h"
#include "rondel/query.h"
#include "support/generators.h"
#include "support/oracle.h"

namespace rondel::test {
namespace {

// 4m rays in order around the z axis, exactly on one circle: (m^2 - k^2, 2mk) has the length
// m^2 + k^2.
std::vector<Point> circle(int m, double height) {
  std::vector<Point> rays;
  for (const double side : {1.0, -1.0}) {
    for (int i = -m; i < m; ++i) {
      const double k = i;
      const double length = m * m + k * k;
      rays.push_back({side * (m * m - k * k), side * 2 * m * k, height * length});
    }
  }
  return rays;
}

struct Work {
  double mean_removed = 0;  // faces removed by an insertion
  std::size_t max_neighbors = 0;
};

// Inserts the apex, then the circle one by one. A site takes the place of d - 2 faces, d the number
// of its neighbors.
Work insert_in_order(const Point& apex, const std::vector<Point>& sites) {
  DynamicTriangulation changing;
  changing.insert(apex);
  Work work;
  for (const Point& p : sites) {
    const Index id = changing.insert(p);
    if (changing.dimension() == 2) {
      work.mean_removed += static_cast<double>(changing.neighbors(id).size()) - 2;
    }
  }
  work.mean_removed /= static_cast<double>(sites.size());
  for (Index id = 1; id <= sites.size(); ++id) {
    work.max_neighbors = std::max(work.max_neighbors, changing.neighbors(id).size());
  }
  return work;
}

void expect_little(const Work& work) {
  EXPECT_LE(work.mean_removed, 4);
  EXPECT_LE(work.max_neighbors, 60U);
}

TEST(dynamic_ties, a_small_circle_in_order_changes_little) {
  expect_little(insert_in_order({0, 0, -1}, circle(2500, 0.5)));
}

TEST(dynamic_ties, a_great_circle_in_order_changes_little) {
  expect_little(insert_in_order({0, 0, 1}, circle(2500, 0)));
}

TEST(dynamic_ties, an_equator_of_longitudes_in_order_changes_little) {
  std::vector<Point> equator;
  for (int i = 0; i < 10000; ++i) equator.push_back(unit_vector({i * 0.036, 0}));
  expect_little(insert_in_order({0, 0, 1}, equator));
}

// Corners of a facet are joined iff, on one way around, all between them are lowered more than
// both.
TEST(dynamic_ties, a_facet_is_a_treap_of_its_corners) {
  for (const double height : {0.5, 0.0}) {
    const std::vector<Point> rays = circle(40, height);
    const std::size_t size = rays.size();
    std::vector<mpz_class> keys(size);
    std::ranges::transform(rays, keys.begin(), hash_of_coordinates);
    std::vector<std::vector<Index>> expected(size);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < size; ++j) {
        const auto hides = [&](std::size_t from, std::size_t to) {
          for (std::size_t k = (from + 1) % size; k != to; k = (k + 1) % size) {
            if (keys[k] >= std::min(keys[i], keys[j])) return false;
          }
          return true;
        };
        if (i != j && (hides(i, j) || hides(j, i))) expected[i].push_back(static_cast<Index>(j));
      }
    }
    std::vector<Point> sites = rays;
    sites.push_back({0, 0, height > 0 ? -1.0 : 1.0});
    const DynamicTriangulation changing(sites);
    for (Index i = 0; i < size; ++i) {
      std::vector<Index> neighbors = changing.neighbors(i);
      std::erase(neighbors, static_cast<Index>(size));
      std::ranges::sort(neighbors);
      EXPECT_EQ(neighbors, expected[i]);
    }
  }
}

// Changes of a range that are told to stop, or whose progress throws. What is left is put together
// by whoever asks first, while others ask: a sanitizer of threads sees whether they read what is
// being written.

constexpr Index num_sites = 8000;
constexpr Index num_changes = 1500;  // so few that no build is faster

std::vector<Point> some_sites(std::size_t n, std::uint64_t seed) {
  return generator("uniform").make(n, seed).sites;
}

struct RangeChange {
  const char* name;
  std::function<void(DynamicTriangulation&, const Execution&)> make;
};

std::vector<RangeChange> range_changes() {
  std::vector<Index> ids(num_changes);
  std::iota(ids.begin(), ids.end(), Index{0});
  const std::vector<Point> more = some_sites(num_changes, 2);
  return {{"insert", [more](auto& t, const auto& execution) { t.insert(more, execution); }},
          {"remove", [ids](auto& t, const auto& execution) { t.remove(ids, execution); }},
          {"move", [ids, more](auto& t, const auto& execution) { t.move(ids, more, execution); }}};
}

TEST(dynamic_stop, leaves_all_as_it_was_and_threads_may_ask) {
  const std::vector<Point> sites = some_sites(num_sites, 1);
  const Triangulation expected = delaunay(sites);
  for (const RangeChange& change : range_changes()) {
    SCOPED_TRACE(change.name);
    DynamicTriangulation changing(sites);
    const std::atomic<bool> stop = true;
    EXPECT_THROW(change.make(changing, {.stop = &stop}), Interrupted);
    const std::vector<std::function<void()>> questions = {
        [&] { EXPECT_EQ(changing.num_faces(), expected.num_faces()); },
        [&] { EXPECT_TRUE(changing.contains(7)); },
        [&] { EXPECT_EQ(changing.ids().size(), num_sites); },
        [&] { EXPECT_EQ(changing.site(5), sites[5]); },
        [&] { EXPECT_EQ(changing.num_sites(), num_sites); },
        [&] { EXPECT_EQ(changing.representative(9), 9U); },
        [&] { EXPECT_TRUE(changing.is_vertex(11)); },
        [&] { EXPECT_EQ(Locator(changing).nearest(sites[3]), 3U); },
        [&] { EXPECT_THROW(static_cast<void>(changing.neighbors(num_sites + 1)), InvalidInput); },
    };
    {
      std::vector<std::jthread> threads;
      for (const auto& ask : questions) threads.emplace_back(ask);
    }
    const Snapshot now = changing.snapshot();
    EXPECT_TRUE(now.triangulation.sites() == expected.sites());
    EXPECT_TRUE(std::ranges::equal(now.triangulation.faces(), expected.faces()));
    change.make(changing, {});
    EXPECT_NE(changing.num_sites() == num_sites, change.name != std::string("move"));
  }
}

TEST(dynamic_stop, progress_is_told_and_may_throw) {
  const std::vector<Point> sites = some_sites(num_sites, 1);
  for (const RangeChange& change : range_changes()) {
    SCOPED_TRACE(change.name);
    DynamicTriangulation changing(sites);
    std::vector<double> told;
    const auto fail = [&told](std::string_view stage, double fraction) {
      EXPECT_EQ(stage, "change");
      told.push_back(fraction);
      throw std::runtime_error("enough");
    };
    EXPECT_THROW(change.make(changing, {.progress = fail}), std::runtime_error);
    EXPECT_EQ(told, std::vector<double>{1024.0 / num_changes});
    EXPECT_EQ(changing.num_sites(), num_sites);
    EXPECT_EQ(changing.num_faces(), 2 * num_sites - 4);
  }
}

}  // namespace
}  // namespace rondel::test
