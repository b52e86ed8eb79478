// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// All named generators: blocks of any size, any number of threads, and a tree of seams change nothing.
#include "unit/bulk/support.h"

namespace rondel::test {
namespace {

class bulk_same : public testing::TestWithParam<Generator> {};

TEST_P(bulk_same, as_the_incremental_build) {
  const Generator& generator = GetParam();
  const std::size_t many = is_shortened() ? 1200 : 2500;
  const std::size_t most = generator.has_long_integers ? 60 : is_extreme(generator) ? 500 : many;
  for (const Model model : {Model::projected, Model::weighted}) {
    if (model == Model::projected && generator.weighted_only) continue;
    for (const std::size_t size : {std::min<std::size_t>(200, most), most}) {
      for (std::uint64_t seed = 0; seed < scaled(2); ++seed) {
        SCOPED_TRACE(text_of(model) + " " + std::to_string(size) + " " + std::to_string(seed));
        BulkCase sites(generator.make(size, seed), model);
        // All sites on one great circle: nothing else makes this fall back.
        const bool is_flat = sites.expected().dimension < 2;
        for (const int block : {40, 100, 1000, 1 << 15}) {
          EXPECT_NE(sites.run(static_cast<std::size_t>(block)), is_flat);
        }
        for (const std::size_t block : {50U, 900U}) {
          EXPECT_NE(sites.run_with_copies(block, 2), is_flat);
        }
        for (const unsigned threads : {2U, 3U, 7U, 16U}) {
          EXPECT_NE(sites.run(120, threads), is_flat);
        }
        EXPECT_NE(sites.run_tree(70), is_flat);
        EXPECT_NE(sites.run_tree(333, 5), is_flat);
        ASSERT_FALSE(HasFailure());
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(generators, bulk_same, testing::ValuesIn(generators()),
                         [](const auto& g) { return std::string(g.param.name); });

}  // namespace
}  // namespace rondel::test
