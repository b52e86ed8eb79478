// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulations by brute force with oracles that share no code with the library are accepted.
#include <gtest/gtest.h>

#include "support/generators.h"
#include "unit/proof/check_support.h"

namespace rondel::test {
namespace {

class CheckValid : public testing::TestWithParam<Model> {};

TEST_P(CheckValid, accepts_every_kind_of_sites) {
  for (const Generator& kind : generators()) {
    if (kind.weighted_only && GetParam() == Model::projected) continue;
    for (const std::size_t n : {3U, 4U, 6U, 9U}) {
      for (std::uint64_t seed = 0; seed < scaled(4); ++seed) {
        const SiteSet set = kind.make(n, seed);
        if (set.sites.size() > 14) continue;
        const Hull hull = brute_force_hull(set.sites, GetParam(), set.sphere);
        const CheckReport report = solid(set.sites, GetParam(), set.sphere).check();
        EXPECT_TRUE(report.is_valid)
            << kind.name << ' ' << n << ' ' << seed << ' ' << report.reason;
        if (hull.dimension < 2) continue;
        EXPECT_EQ(report.num_duplicates, hull.duplicates.size()) << kind.name;
        EXPECT_EQ(report.num_hidden, hull.hidden.size()) << kind.name;
        EXPECT_EQ(2 * report.num_edges, 3 * hull.faces.size()) << kind.name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(models, CheckValid, testing::Values(Model::projected, Model::weighted),
                         [](const auto& model) {
                           return model.param == Model::projected ? "projected" : "weighted";
                         });

TEST(check_valid, ignores_the_order_of_faces_and_of_their_corners) {
  Random random(2);
  Solid cube = solid(cube_sites());
  for (int repeat = 0; repeat < 20; ++repeat) {
    random.shuffle(cube.faces);
    for (Triple& face : cube.faces) {
      std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random.below(3)),
                  face.end());
    }
    EXPECT_EQ(cube.reason(), "");
  }
}

TEST(check_valid, tells_how_far_it_is) {
  Solid cube = solid(cube_sites());
  std::vector<double> told;
  cube.progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "check");
    told.push_back(fraction);
  };
  EXPECT_EQ(cube.reason(), "");
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_EQ(told.front(), 0);
  EXPECT_EQ(told.back(), 1);
}

}  // namespace
}  // namespace rondel::test
