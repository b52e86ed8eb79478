// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Builds by ranks: what they have together is the build in memory, bit by bit, whatever the number of
// ranks, the shares of the sites, the squares and the rounds.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "bulk/triangulate.h"
#include "bulk_support.h"
#include "distributed_ranks_support.h"

namespace rondel::test {
namespace {

// Far apart from what 32 bits can count.
constexpr std::uint64_t first_number = std::uint64_t{1} << 40;

RankResults build(std::span<const Point> sites, int num_ranks,
                  const distributed::RankLimits& limits, const system::Job& options) {
  SimulatedRanks ranks(num_ranks);
  RankResults all;
  std::vector<DistributedTriangulation> parts(static_cast<std::size_t>(num_ranks),
                                              DistributedTriangulation(nullptr));
  const auto errors = ranks.run([&](Communicator& rank) {
    parts[static_cast<std::size_t>(rank.rank())] =
        DistributedTriangulation(distributed::build_on_ranks(
            rank, share(sites, rank.rank(), num_ranks, 7), limits, options));
  });
  for (const std::string& error : errors) EXPECT_EQ(error, "");
  if (testing::Test::HasFailure()) return all;
  for (const auto& part : parts) append(part, limits.first_number, all);
  return all;
}

class distributed_ranks : public testing::TestWithParam<Generator> {};

TEST_P(distributed_ranks, as_the_build_in_memory) {
  const Generator& generator = GetParam();
  const std::size_t size = generator.has_long_integers ? 40 : is_extreme(generator) ? 200 : 1000;
  for (const Model model : {Model::projected, Model::weighted}) {
    if (model == Model::projected && generator.weighted_only) continue;
    const SiteSet set = generator.make(size, 1);
    const system::Job options{{.model = model, .sphere = set.sphere}, {.threads = 1}};
    const Triangulation expected = delaunay(Sites::view(set.sites), options, options);
    for (const int num_ranks : {1, 2, 3, 5, 16}) {
      for (const std::uint64_t most_bucket_sites : {40U, 200U, 100000U}) {
        SCOPED_TRACE(text_of(model) + ", ranks: " + std::to_string(num_ranks) + ", squares of " +
                     std::to_string(most_bucket_sites));
        expect_same(build(set.sites, num_ranks, {most_bucket_sites, 100, first_number}, options),
                    expected, first_number);
        ASSERT_FALSE(HasFailure());
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(generators, distributed_ranks, testing::ValuesIn(generators()),
                         [](const auto& g) { return std::string(g.param.name); });

// Fewer sites than ranks, and none.
TEST(distributed_rank, may_have_no_sites) {
  const SiteSet set = generator("uniform").make(20, 3);
  const system::Job options{{.sphere = set.sphere}, {.threads = 1}};
  for (std::size_t n = 0; n <= set.sites.size(); ++n) {
    SCOPED_TRACE(n);
    const auto sites = std::span(set.sites).first(n);
    const Triangulation expected = delaunay(Sites::view(sites), options, options);
    for (const int num_ranks : {1, 4, 16}) {
      expect_same(build(sites, num_ranks, {1, 3, first_number}, options), expected, first_number);
      ASSERT_FALSE(HasFailure());
    }
  }
}

// All at one place, and all but one.
TEST(distributed_rank, may_have_copies_alone) {
  std::vector<Point> sites(50, {1, 2, 3});
  const system::Job options{{}, {.threads = 1}};
  for (int i = 0; i < 2; ++i) {
    const Triangulation expected = delaunay(Sites::view(sites), options, options);
    expect_same(build(sites, 5, {10, 7, first_number}, options), expected, first_number);
    sites.push_back({3, 2, 1});
  }
}

// Squares from this size on are triangulated from copies of their sites; some are duplicates.
TEST(distributed_rank, may_have_a_large_square) {
  if (is_shortened()) GTEST_SKIP() << "takes long here";
  std::vector<Point> sites;
  Random random(5);
  while (sites.size() < bulk::least_copied_sites + 1000) {
    const Point p = random.in_cube();
    sites.push_back({p.x / 2, p.y / 2, 1});
    if (sites.size() % 100 == 0) sites.push_back(sites[sites.size() / 2]);
  }
  const system::Job options{{}, {.threads = 2}};
  const Triangulation expected = delaunay(Sites::view(sites), options, options);
  const std::uint64_t all = sites.size();
  expect_same(build(sites, 1, {all, all, first_number}, options), expected, first_number);
}

// The bar for what is sent beside the sites is 12 kB * sqrt(n P). Shares differ by less than 5 %.
TEST(distributed_rank, sends_little_and_works_as_much_as_others) {
  constexpr int num_ranks = 8;
  constexpr std::size_t n = 200000;
  const SiteSet set = generator("uniform").make(n, 1);
  SimulatedRanks ranks(num_ranks);
  std::vector<std::size_t> sizes(num_ranks);
  const auto errors = ranks.run([&](Communicator& rank) {
    const auto r = static_cast<std::size_t>(rank.rank());
    const auto part = delaunay(rank, std::span(set.sites).subspan(r * n / num_ranks, n / num_ranks),
                               {}, {.sphere = set.sphere}, {.threads = 1});
    sizes[r] = part.owned_sites().size();
  });
  for (const std::string& error : errors) EXPECT_EQ(error, "");
  const auto most = static_cast<double>(std::ranges::max(sizes));
  EXPECT_LT(most, 1.05 * n / num_ranks);
  const auto sent = static_cast<double>(ranks.bytes_sent() - ranks.bytes_sent("deal"));
  EXPECT_LT(sent, 12e3 * std::sqrt(double{n} * num_ranks));
  std::printf("%.2f kB * sqrt(n P)\n", sent / 1e3 / std::sqrt(double{n} * num_ranks));
  for (const char* phase : {"count", "deal", "triangulate", "join", "number", "finish"})
    std::printf("%s %.2f MB\n", phase, static_cast<double>(ranks.bytes_sent(phase)) / 1e6);
}

}  // namespace
}  // namespace rondel::test
