// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Any number of threads that a caller can name gives the answer.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "rondel/io.h"
#include "rondel/rondel.h"
#include "support/generators.h"
#include "support/temporary_files.h"
#include "system/parallel.h"

namespace rondel {
namespace {

constexpr unsigned thread_counts[] = {0,
                                      1,
                                      2,
                                      1023,
                                      1024,
                                      1025,
                                      1U << 16,
                                      100'000'000,
                                      1U << 30,
                                      3U << 30,
                                      std::numeric_limits<unsigned>::max()};

TEST(threads, are_at_most_1024) {
  for (const unsigned threads : thread_counts) {
    EXPECT_GE(system::num_threads(threads), 1U);
    EXPECT_LE(system::num_threads(threads), 1024U);
  }
  EXPECT_EQ(system::num_threads(2),
            system::num_threads(1) == 1 && system::num_threads(7) == 1 ? 1U : 2U);
}

TEST(threads, of_any_number_triangulate) {
  for (const std::size_t n : {0U, 5U, 20000U}) {
    const std::vector<Point> sites = test::generator("uniform").make(n, 1).sites;
    for (const Model model : {Model::projected, Model::weighted}) {
      const Triangulation expected = delaunay(sites, {.model = model}, {.threads = 1});
      for (const unsigned threads : thread_counts) {
        SCOPED_TRACE(threads);
        const Triangulation t = delaunay(sites, {.model = model}, {.threads = threads});
        EXPECT_TRUE(std::ranges::equal(t.faces(), expected.faces()));
        EXPECT_EQ(check(sites, t.faces(), {.model = model}, {.threads = threads}).reason, "");
      }
    }
  }
}

TEST(threads, of_any_number_answer_and_write) {
  const std::vector<Point> sites = test::generator("uniform").make(9000, 1).sites;
  const Triangulation t = delaunay(sites);
  const Locator locator(t);
  const std::string path = temporary_path("threads.csv");
  const auto expected = locator.nearest(sites, {.threads = 1});
  for (const unsigned threads : thread_counts) {
    SCOPED_TRACE(threads);
    EXPECT_EQ(locator.nearest(sites, {.threads = threads}), expected);
    EXPECT_EQ(locator.within(sites, 0.01, {.threads = threads}).offsets.size(), sites.size() + 1);
    write_sites(path, sites, {}, {}, {.threads = threads});
    EXPECT_EQ(read_sites(path).sites.size(), sites.size());
  }
}

}  // namespace
}  // namespace rondel
