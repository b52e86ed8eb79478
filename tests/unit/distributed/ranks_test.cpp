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
#include "unit/bulk/support.h"
#include "unit/distributed/ranks_support.h"

namespace rondel::test {
namespace {

// Far apart from what 32 bits can count.
constexpr std::uint64_t first_number = std::uint64_t{1} << 40;

RankResults build(std::span<const Point> sites, int num_ranks, distributed::RankLimits limits,
                  const system::Job& options) {
  limits.keep_points = true;
  SimulatedRanks ranks(num_ranks);
  RankResults all;
  std::vector<DistributedTriangulation> parts(static_cast<std::size_t>(num_ranks),
                                              DistributedTriangulation(nullptr));
  std::vector<std::vector<double>> areas_of(parts.size());
  const auto errors = ranks.run([&](Communicator& rank) {
    const auto r = static_cast<std::size_t>(rank.rank());
    parts[r] = DistributedTriangulation(distributed::build_on_ranks(
        rank, share(sites, rank.rank(), num_ranks, 7), limits, options));
    areas_of[r] = areas(rank, parts[r], options);
  });
  for (const std::string& error : errors) EXPECT_EQ(error, "");
  if (testing::Test::HasFailure()) return all;
  for (std::size_t r = 0; r < parts.size(); ++r)
    append(parts[r], areas_of[r], limits.first_number, all, options.threads);
  return all;
}

class distributed_ranks : public testing::TestWithParam<Generator> {};

TEST_P(distributed_ranks, as_the_build_in_memory) {
  const Generator& generator = GetParam();
  const std::size_t size = generator.has_long_integers ? 40 : is_extreme(generator) ? 200 : 1000;
  int num_builds = 0;
  for (const Model model : {Model::projected, Model::weighted}) {
    if (model == Model::projected && generator.weighted_only) continue;
    const SiteSet set = generator.make(size, 1);
    const system::Job options{{.model = model, .sphere = set.sphere}, {.threads = 1}};
    const Triangulation expected = delaunay(Sites::view(set.sites), options, options);
    for (const int num_ranks : {1, 2, 3, 5, 16}) {
      for (const std::uint64_t max_bucket_sites : {40U, 200U, 100000U}) {
        // Every fourth, in which each number of ranks and each size comes.
        if (++num_builds % 4 != 0 && is_shortened()) continue;
        SCOPED_TRACE(text_of(model) + ", ranks: " + std::to_string(num_ranks) + ", squares of " +
                     std::to_string(max_bucket_sites));
        expect_same(build(set.sites, num_ranks, {max_bucket_sites, 100, first_number}, options),
                    expected, first_number);
        ASSERT_FALSE(HasFailure());
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(generators, distributed_ranks, testing::ValuesIn(generators()),
                         [](const auto& g) { return std::string(g.param.name); });

// So many that areas and circumcenters are found in pieces, by threads.
TEST(distributed_rank, may_have_many_sites) {
  const SiteSet set = generator("uniform").make(100000, 3);
  for (const Model model : {Model::projected, Model::weighted}) {
    const system::Job options{{.model = model, .sphere = set.sphere}, {.threads = 2}};
    const Triangulation expected = delaunay(Sites::view(set.sites), options, options);
    expect_same(build(set.sites, 2, {100000, 30000, first_number}, options), expected,
                first_number);
  }
}

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
  while (sites.size() < bulk::min_copied_sites + 1000) {
    const Point p = random.in_cube();
    sites.push_back({p.x / 2, p.y / 2, 1});
    if (sites.size() % 100 == 0) sites.push_back(sites[sites.size() / 2]);
  }
  const system::Job options{{}, {.threads = 2}};
  const Triangulation expected = delaunay(Sites::view(sites), options, options);
  const std::uint64_t all = sites.size();
  expect_same(build(sites, 1, {all, all, first_number}, options), expected, first_number);
}

// Each rank sends one of many copies; some of them are others in few bits, or on the same ray.
TEST(distributed_rank, sends_copies_once) {
  constexpr std::size_t n = 150000;
  const std::vector<Point> places = {{1, 2, 0}, {1, 2, -0.0}, {3, 6, 0}, {0, 1, 1}};
  std::vector<Point> sites(n, places[0]);
  Random random(3);
  for (std::size_t i = 0; i < n; i += 50) sites[i] = places[random.below(places.size())];
  for (std::size_t i = 7; i < n; i += 5000) sites[i] = random.direction();
  for (const Model model : {Model::projected, Model::weighted}) {
    const system::Job options{{.model = model}, {.threads = 1}};
    const Triangulation expected = delaunay(Sites::view(sites), options, options);
    for (const int num_ranks : {1, 4}) {
      expect_same(build(sites, num_ranks, {100, 3000, first_number}, options), expected,
                  first_number);
    }
  }
  SimulatedRanks ranks(4);
  ranks.run([&](Communicator& rank) {
    delaunay(rank, share(sites, rank.rank(), 4, 7), {}, {}, {.threads = 1});
  });
  EXPECT_LT(ranks.bytes_sent("scatter"), 4000U);
}

// Of copies on one ray the lowest index names the place, and its point counts for areas and circumcenters;
// which are so close that another one, known to as many bits, gives others.
TEST(distributed_rank, has_copies_of_other_lengths) {
  Random random(9);
  std::vector<Point> sites;
  for (int i = 0; i < 300; ++i) {
    const auto digit = [&] { return static_cast<double>(random.below(100)); };
    const Point ray = {digit(), digit(), 1e15 + digit()};
    for (const double length : {3.0, 1.0, 5.0})
      sites.push_back((i % 2 == 0 ? length : 6 - length) * ray);
  }
  const system::Job options{{}, {.threads = 1}};
  const Triangulation expected = delaunay(Sites::view(sites), options, options);
  for (const int num_ranks : {1, 3}) {
    for (const std::uint64_t max_bucket_sites : {50U, 100000U}) {
      expect_same(build(sites, num_ranks, {max_bucket_sites, 70, first_number}, options), expected,
                  first_number);
    }
  }
}

// Corners in line have a normal by what is not on their line: with the center on an edge of the hull, in
// a face of it, or outside, some of the sites that tell are on other ranks.
TEST(distributed_rank, has_weighted_sites_in_line) {
  for (unsigned seed = 0; seed < scaled(60); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Point> sites;
    for (int i = 0; i < 60; ++i) {
      const auto digit = [&] { return static_cast<double>(random.below(5)) - 2; };
      const double y = seed % 3 == 0 ? digit() : std::abs(digit());
      const double z = seed % 2 == 0 ? std::abs(digit()) : digit() + 2;
      const double scale =
          z == 0 ? 5 : 1;  // the one with the largest coordinate is on the plane, too
      sites.push_back({scale * digit(), scale * y, z});
    }
    const system::Job options{{.model = Model::weighted}, {.threads = 1}};
    const Triangulation expected = delaunay(Sites::view(sites), options, options);
    expect_same(build(sites, seed % 4 < 2 ? 16 : 3, {seed % 5 + 1, 70, first_number}, options),
                expected, first_number);
    ASSERT_FALSE(HasFailure());
  }
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
  const auto sent = static_cast<double>(ranks.bytes_sent() - ranks.bytes_sent("scatter"));
  EXPECT_LT(sent, 12e3 * std::sqrt(double{n} * num_ranks));
  std::printf("%.2f kB * sqrt(n P)\n", sent / 1e3 / std::sqrt(double{n} * num_ranks));
  for (const char* phase : {"count", "scatter", "triangulate", "join", "number", "finish"})
    std::printf("%s %.2f MB\n", phase, static_cast<double>(ranks.bytes_sent(phase)) / 1e6);
}

}  // namespace
}  // namespace rondel::test
