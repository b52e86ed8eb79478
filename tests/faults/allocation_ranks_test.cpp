// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A build by ranks, of which one does not get its memory: all of them throw, and none waits for another
// one.

#include <algorithm>
#include <atomic>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "faults/failing_allocation.h"
#include "rondel/distributed.h"
#include "support/generators.h"
#include "support/simulated_ranks.h"

namespace rondel::test {
namespace {

constexpr int num_ranks = 2;

TEST(Allocation, ranks) {
  for (const char* name : {"uniform", "small_circle"}) {
    SiteSet set = generator(name).make(20, 1);
    set.sites.push_back(set.sites.front());
    bool has_failed = true;
    for (std::size_t n = 1; has_failed; n = next_to_fail(n)) {
      const std::size_t before = blocks_in_use();
      {
        SimulatedRanks ranks(num_ranks);
        std::atomic<int> num_done = 0;
        std::atomic<bool> is_armed = false;
        std::atomic<std::size_t> allocation = n;
        std::optional<FailingAllocation> failing;
        ranks.on_begin = [&](int /*rank*/, std::string_view /*phase*/) {
          if (!is_armed.exchange(true)) failing.emplace(allocation, Shortage::of_one_block);
        };
        const auto errors = ranks.run([&](Communicator& rank) {
          const auto r = static_cast<std::size_t>(rank.rank());
          const auto sites =
              std::span(set.sites).subspan(r * 10, r == 0 ? 10 : set.sites.size() - 10);
          const auto part = delaunay(
              rank, sites, {.max_bucket_sites = 5, .max_scattered_sites = 4, .keep_points = true},
              {.sphere = set.sphere}, {.threads = 1});
          num_done += areas(rank, part, {.threads = 1}).size() == sites.size();
        });
        has_failed = failing->stop();
        EXPECT_EQ(num_done, has_failed ? 0 : num_ranks) << errors[0] << ", " << errors[1];
      }
      ASSERT_FALSE(testing::Test::HasFailure()) << name << ", allocation " << n;
      ASSERT_EQ(blocks_in_use(), before) << name << ", allocation " << n;
    }
  }
}

}  // namespace
}  // namespace rondel::test
