// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// If one rank fails, all ranks end with the same line.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "rondel/error.h"
#include "unit/distributed/ranks_support.h"

namespace rondel::test {
namespace {

constexpr int three = 3;
constexpr std::array phases = {"count",  "scatter", "triangulate", "join",
                               "number", "finish",  "areas"};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class distributed_failure : public testing::Test {
 protected:
  distributed_failure() : sites_(generator("uniform").make(300, 1).sites) {}

  std::vector<std::string> run(SimulatedRanks& ranks) const {
    return ranks.run([&](Communicator& rank) {
      const auto mine = share(sites_, rank.rank(), three, 1);
      const auto part = delaunay(
          rank, mine, {.max_bucket_sites = 50, .max_scattered_sites = 40, .keep_points = true}, {},
          {.threads = 1});
      num_done_ += areas(rank, part, {.threads = 1}).size() == mine.size();
    });
  }

  std::vector<Point> sites_;
  mutable std::atomic<int> num_done_ = 0;
};

// The communicator itself, at each call of each rank.
TEST_F(distributed_failure, of_a_call_ends_all) {
  for (int failing = 0; failing < three; ++failing) {
    std::uint64_t num_calls = 0;
    for (bool has_failed = true; has_failed; ++num_calls) {
      has_failed = false;
      SimulatedRanks ranks(three);
      ranks.on_call = [&](int rank, std::uint64_t call) {
        if (rank != failing || call != num_calls) return;
        has_failed = true;
        throw std::runtime_error("unplugged");
      };
      num_done_ = 0;
      const auto errors = run(ranks);
      for (int r = 0; r < three; ++r) {
        const std::string& error = errors[static_cast<std::size_t>(r)];
        EXPECT_EQ(error, !has_failed    ? ""
                         : r == failing ? "unplugged"
                                        : std::string("a rank has gone"));
      }
      EXPECT_EQ(num_done_, has_failed ? 0 : three);
    }
    EXPECT_GT(num_calls, 20U);
  }
}

// The work of a rank.
TEST_F(distributed_failure, of_work_is_told_to_all) {
  for (int failing = 0; failing < three; ++failing) {
    for (const char* phase : phases) {
      SimulatedRanks ranks(three);
      ranks.on_begin = [&](int rank, std::string_view name) {
        if (rank == failing && name == phase) throw std::runtime_error("too\nmuch");
      };
      num_done_ = 0;
      for (const std::string& error : run(ranks)) {
        EXPECT_TRUE(error.starts_with("rank " + std::to_string(failing) + ", ")) << error;
        EXPECT_TRUE(error.ends_with(": too much")) << error;
      }
      EXPECT_EQ(num_done_, 0);
    }
  }
}

TEST_F(distributed_failure, names_the_first_site_that_is_not_valid) {
  sites_[280].y = nan;
  sites_[150].x = nan;
  SimulatedRanks ranks(three);
  int failing = 0;
  std::size_t end = 0;
  for (int r = 0; end <= 150; ++r) {
    failing = r;
    end += share(sites_, r, three, 1).size();
  }
  const auto errors = run(ranks);
  EXPECT_TRUE(
      errors[0].starts_with("rank " + std::to_string(failing) + ", count: site 150: (nan, "))
      << errors[0];
  for (const std::string& error : errors) EXPECT_EQ(error, errors[0]);
}

TEST_F(distributed_failure, is_an_option_that_is_not_valid) {
  SimulatedRanks ranks(three);
  const auto errors = ranks.run([&](Communicator& rank) {
    delaunay(rank, {}, {}, {.sphere = {{}, -1}}, {.threads = 1});
  });
  for (const std::string& error : errors) {
    EXPECT_EQ(error, "rank 0, count: the squared radius -1 of the sphere is not positive");
  }
}

TEST_F(distributed_failure, throws_one_type_with_the_rank) {
  SimulatedRanks ranks(three);
  ranks.on_begin = [&](int rank, std::string_view /*phase*/) {
    if (rank != 0) throw std::bad_alloc();
  };
  std::atomic<int> num_caught = 0;
  ranks.run([&](Communicator& rank) {
    try {
      delaunay(rank, share(sites_, rank.rank(), three, 1));
    } catch (const DistributedError& error) {
      num_caught += error.rank() == 1;
    }
  });
  EXPECT_EQ(num_caught, three);
}

// Without the points.
TEST_F(distributed_failure, is_to_ask_for_areas_that_nobody_can_tell) {
  SimulatedRanks ranks(three);
  const auto errors = ranks.run([&](Communicator& rank) {
    const auto part = delaunay(rank, share(sites_, rank.rank(), three, 1), {}, {}, {.threads = 1});
    EXPECT_THROW(part.visit_circumcenters([](std::span<const Point>) {}), InvalidInput);
    areas(rank, part);
  });
  for (const std::string& error : errors) {
    EXPECT_EQ(error,
              "rank 0, areas: the points were not kept: see DistributedOptions::keep_points");
  }
}

// The flag of one rank, set at the beginning of each phase.
TEST_F(distributed_failure, interrupts_all) {
  for (const char* phase : phases) {
    SimulatedRanks ranks(three);
    std::atomic<bool> stop = false;
    ranks.on_begin = [&](int rank, std::string_view name) {
      if (rank == 1 && name == phase) stop = true;
    };
    std::atomic<int> num_interrupted = 0;
    ranks.run([&](Communicator& rank) {
      try {
        const Execution execution = {.threads = 1, .stop = rank.rank() == 1 ? &stop : nullptr};
        areas(rank,
              delaunay(rank, share(sites_, rank.rank(), three, 1), {.keep_points = true}, {},
                       execution),
              execution);
      } catch (const Interrupted&) {
        ++num_interrupted;
      }
    });
    EXPECT_EQ(num_interrupted, three) << phase;
  }
}

}  // namespace
}  // namespace rondel::test
