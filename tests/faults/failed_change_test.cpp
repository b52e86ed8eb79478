// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// After a change that failed for want of memory, the triangulation is built anew by whoever asks
// first, while others ask. A sanitizer of threads sees whether they read what is being written.

#include <gtest/gtest.h>

#include <functional>
#include <thread>
#include <vector>

#include "faults/failing_allocation.h"
#include "rondel/dynamic.h"
#include "rondel/error.h"
#include "rondel/query.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

TEST(failed_change, may_be_followed_by_questions_of_several_threads) {
  constexpr std::size_t num_sites = 300;
  const std::vector<Point> sites = generator("uniform").make(num_sites, 1).sites;
  const Point more = generator("uniform").make(1, 2).sites.front();
  for (int round = 0; round < 20; ++round) {
    DynamicTriangulation changing(sites);
    {
      const FailingAllocation failing(1, Shortage::from_there_on);
      EXPECT_THROW(changing.insert(more), std::bad_alloc);
    }
    const std::vector<std::function<void()>> questions = {
        [&] { EXPECT_EQ(changing.num_faces(), 2 * num_sites - 4); },
        [&] { EXPECT_TRUE(changing.contains(7)); },
        [&] { EXPECT_EQ(changing.ids().size(), num_sites); },
        [&] { EXPECT_EQ(changing.site(5), sites[5]); },
        [&] { EXPECT_EQ(changing.num_sites(), num_sites); },
        [&] { EXPECT_EQ(changing.representative(9), 9U); },
        [&] { EXPECT_TRUE(changing.is_vertex(11)); },
        [&] { EXPECT_EQ(Locator(changing).nearest(sites[3]), 3U); },
        [&] { EXPECT_THROW(static_cast<void>(changing.neighbors(num_sites + 1)), InvalidInput); },
    };
    std::vector<std::jthread> threads;
    for (const auto& ask : questions) threads.emplace_back(ask);
  }
}

}  // namespace
}  // namespace rondel::test
