// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Changes of a range that are told to stop, or whose progress throws. What is left is put together
// by whoever asks first, while others ask: a sanitizer of threads sees whether they read what is
// being written.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
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

namespace rondel::test {
namespace {

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
