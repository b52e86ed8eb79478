// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Larger triangulations are closed surfaces whose edges are all regular by the exact oracle.
#include "property/property.h"
#include "support/surface_check.h"

namespace rondel::test {
namespace {

std::string error_of(const Triangulation& t, const SiteSet& set) {
  if (auto error = topology_error(t); !error.empty()) return error;
  if (auto error = order_error(t); !error.empty()) return error;
  return geometry_error(t, set.sites);
}

class surface : public testing::TestWithParam<Generator> {};

TEST_P(surface, is_exactly_the_perturbed_hull) {
  for (const std::size_t n : {40U, GetParam().has_long_integers ? 100U : 400U}) {
    for (std::uint64_t seed = 0; seed < scaled(2); ++seed) {
      const SiteSet set = GetParam().make(n, seed);
      for (const Model model : {Model::projected, Model::weighted}) {
        if (model == Model::projected && GetParam().weighted_only) continue;
        EXPECT_EQ(error_of(triangulate(set, model), set), "")
            << (model == Model::projected ? "projected" : "weighted") << " n=" << n
            << " seed=" << seed;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(kinds, surface,
                         testing::ValuesIn(generators().begin(), generators().end()),
                         [](const auto& kind) { return std::string(kind.param.name); });

// The paper's hard set: all sites are vertices, in both models, duplicates aside.
TEST(paper, all_sites_of_s_n_are_vertices) {
  for (const std::size_t n : {100U, 250U, 1500U}) {
    const SiteSet set{paper_s(n)};
    for (const Model model : {Model::projected, Model::weighted}) {
      const Triangulation t = triangulate(set, model);
      EXPECT_EQ(error_of(t, set), "");
      EXPECT_EQ(t.num_vertices(), distinct_places(set.sites, model, {}).index.size());
      EXPECT_TRUE(t.hidden().empty());
    }
  }
}

TEST(paper, all_sites_of_s_100000_are_vertices) {
  const SiteSet set{paper_s(100000)};
  for (const Model model : {Model::projected, Model::weighted}) {
    const Triangulation t = triangulate(set, model);
    EXPECT_EQ(topology_error(t), "");
    EXPECT_EQ(t.num_vertices() + t.duplicates().size(), set.sites.size());
    EXPECT_TRUE(t.hidden().empty());
  }
}

TEST(dense_patch, loses_no_site) {
  SiteSet set = generator("patch_1e_6").make(20000, 1);
  const SiteSet globe = generator("uniform").make(100, 2);
  set.sites.insert(set.sites.end(), globe.sites.begin(), globe.sites.end());
  const Triangulation t = triangulate(set, Model::projected);
  EXPECT_EQ(topology_error(t), "");
  EXPECT_EQ(t.num_vertices() + t.duplicates().size(), set.sites.size());
  EXPECT_LT(t.duplicates().size(), 3U);
}

}  // namespace
}  // namespace rondel::test
